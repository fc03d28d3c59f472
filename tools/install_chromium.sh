#!/bin/sh
# The browser that checks and prints the book: that of the system, else Debian's, installed by apt.
# Ends with 3, and says so, where there is none and it cannot be installed.
set -u
for name in chromium chromium-browser google-chrome-stable google-chrome; do
  if command -v "$name" >/dev/null 2>&1; then
    echo "chromium: $(command -v "$name")"
    exit 0
  fi
done
if ! command -v apt-get >/dev/null 2>&1; then
  echo "NOT INSTALLED: no Chromium, and no apt-get to install it with; what needs a browser is not run" >&2
  exit 3
fi
as_root=""
[ "$(id -u)" = 0 ] || as_root="sudo -n"
echo "installing chromium with apt-get"
# A machine without a network has to be told so soon, not after apt's many tries.
soon="-o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o Acquire::https::Timeout=20 -o DPkg::Lock::Timeout=60"
if timeout 300 $as_root apt-get update -qq $soon && timeout 900 $as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq $soon --no-install-recommends chromium >/dev/null && command -v chromium >/dev/null; then
  echo "chromium: $(command -v chromium)"
else
  echo "NOT INSTALLED: apt-get could not install chromium; what needs a browser is not run" >&2
  exit 3
fi
