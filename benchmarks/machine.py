"""What a run was measured on: processor, vector instructions, cores, memory, and its load."""

from __future__ import annotations

import os
import platform
from pathlib import Path

#: Vector instructions by the flag that the kernel of Linux lists, the widest first.
_VECTORS = {"avx512f": "AVX-512", "avx2": "AVX2", "asimd": "NEON", "sse2": "SSE2"}


def machine() -> dict[str, object]:
    """Processor, vector instructions, cores, memory [GB], system and Python; no name, no date."""
    text = _read("/proc/cpuinfo")
    flags = _field(text, "flags") or _field(text, "Features")
    vectors = next((name for flag, name in _VECTORS.items() if flag in flags.split()), "unknown")
    return {
        "cpu": _field(text, "model name") or platform.processor() or platform.machine(),
        "vectors": vectors,
        "cores": os.cpu_count(),
        "memory_gb": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9, 1),
        "system": platform.system(),
        "python": platform.python_version(),
    }


def load() -> float:
    """Processes that ran or waited for a core, mean of the last minute."""
    return round(os.getloadavg()[0], 2)


def _read(path: str) -> str:
    try:
        return Path(path).read_text(encoding="utf-8")
    except OSError:
        return ""


def _field(text: str, name: str) -> str:
    for line in text.splitlines():
        if line.partition(":")[0].strip() == name:
            return line.partition(":")[2].strip()
    return ""
