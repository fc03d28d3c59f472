# Python, git and make; the environment is what the lock says, and every file of it has a hash.
FROM python:3.11-slim-bookworm AS base
RUN apt-get update \
 && apt-get install -y --no-install-recommends git make \
 && rm -rf /var/lib/apt/lists/* \
 && useradd --create-home reader \
 && install -d -o reader -g reader /opt/dualarm_repro
USER reader

FROM base AS book
WORKDIR /opt/dualarm_repro
# The lock alone first: this layer stays as long as the lock does.
COPY --chown=reader requirements.lock ./
RUN python -m venv .venv \
 && .venv/bin/python -m pip install --no-cache-dir --no-deps --require-hashes -r requirements.lock
COPY --chown=reader . .
RUN make env
ENV PATH=/opt/dualarm_repro/.venv/bin:$PATH
CMD ["make", "help"]
