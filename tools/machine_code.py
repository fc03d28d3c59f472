"""Which machine code numba, numpy, OpenBLAS and the C library run, and how to choose other."""

from __future__ import annotations

import ctypes
import hashlib
import math
import platform
import random
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

#: Core types of OpenBLAS, widest first, and the feature a processor needs to run them.
_CORES = (("SkylakeX", "X86_V4"), ("Haswell", "AVX2"), ("Nehalem", "SSE42"), ("Prescott", "SSE3"))
_CORE_SYMBOLS = ("scipy_openblas_get_corename64_", "scipy_openblas_get_corename")
#: Features by which the C library selects its elementary functions.
_LIBM = "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F"
_BLAS = "OPENBLAS_CORETYPE"
#: Environment variable: compile the kernels of a process with fused multiply-add.
FUSED = "VERIFY_PORTABLE_FUSED"


@dataclass(frozen=True)
class Setting:
    """Environment variables, and the parts of :func:`probe` that they must change."""

    name: str
    environment: dict[str, str] = field(default_factory=dict)
    changes: dict[str, Any] = field(default_factory=dict)

    @property
    def kernels(self) -> str:
        """Names the folder of compiled kernels, which differ with target and fusing."""
        target = self.environment.get("NUMBA_CPU_NAME", "host")
        return f"{target}-fused" if FUSED in self.environment else target

    def without_effect(self, machine: dict[str, Any]) -> list[str]:
        """What the process still ran as if nothing had been set; empty if all took effect."""
        return [
            f"no effect on {key}: {machine[key]}"
            for key, before in self.changes.items()
            if machine[key] == before
        ]


def probe() -> dict[str, Any]:
    """The machine code this process runs: numba's target, numpy's kernels, OpenBLAS cores, libm."""
    import scipy.linalg  # noqa: F401
    from numba.core.registry import cpu_target

    triple, cpu, features = cpu_target.target_context.codegen().magic_tuple()
    return {
        "numba": {"triple": triple, "cpu": cpu, "fma": "+fma" in features.split(",")},
        "fused": _fuses(),
        "numpy": _numpy_dispatch(),
        "blas": _blas_cores(),
        "libm": _libm_digest(),
    }


def settings() -> list[Setting]:
    """The settings that this machine can be run under, seen from a process that has none."""
    here = probe()
    parts = [Setting("numba", {"NUMBA_CPU_NAME": "generic"}, {"numba": here["numba"]})]
    if here["numpy"]:
        names = " ".join(here["numpy"])
        parts.append(
            Setting("numpy", {"NPY_DISABLE_CPU_FEATURES": names}, {"numpy": here["numpy"]})
        )
    for core in _other_cores(set(here["blas"].values()))[:2]:
        parts.append(Setting(f"blas-{core.lower()}", {_BLAS: core}, {"blas": here["blas"]}))
    if platform.libc_ver()[0] == "glibc" and platform.machine() == "x86_64":
        parts.append(Setting("libm", {"GLIBC_TUNABLES": _LIBM}, {"libm": here["libm"]}))
    together = Setting(
        "everything",
        {key: value for part in parts for key, value in part.environment.items()},
        {key: value for part in parts for key, value in part.changes.items()},
    )
    made = [Setting("nominal"), *parts, together]
    if here["numba"]["fma"]:
        made.append(Setting("fused", {FUSED: "1"}, {"fused": here["fused"]}))
    return made


def fuse_kernels() -> None:
    """Let every kernel that is compiled from now on round once in a*b + c, as some compilers do."""
    import numba

    plain = numba.njit

    def njit(*arguments: Any, **options: Any) -> Any:
        if arguments and callable(arguments[0]):
            return plain(fastmath={"contract"})(arguments[0])
        return plain(*arguments, **{"fastmath": {"contract"}, **options})

    numba.njit = njit


def _fuses() -> bool:
    """Whether a kernel compiled here rounds a*b + c once: then x*x - fl(x*x) is not zero."""
    import numba

    kernel = numba.njit(lambda a, b: a * a + b)
    x = 1.0 + 2.0**-30
    return kernel(x, -(x * x)) != 0.0


def _numpy_dispatch() -> list[str]:
    """Features beyond the baseline for which numpy carries kernels that it would run here."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    return [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]


def _other_cores(used: set[str]) -> list[str]:
    from numpy._core._multiarray_umath import __cpu_features__

    if not used or platform.machine() not in ("x86_64", "AMD64"):
        return []
    return [core for core, need in _CORES if __cpu_features__.get(need) and core not in used]


def _blas_cores() -> dict[str, str]:
    """Core type of every OpenBLAS of numpy and scipy in this process."""
    maps = Path("/proc/self/maps")
    if not maps.is_file():
        return {}
    lines = maps.read_text(encoding="utf-8").splitlines()
    found = {}
    for path in sorted({line.split()[-1] for line in lines if "openblas" in line}):
        library = ctypes.CDLL(path)
        for symbol in _CORE_SYMBOLS:
            if hasattr(library, symbol):
                ask = getattr(library, symbol)
                ask.restype = ctypes.c_char_p
                found[Path(path).parent.name] = ask().decode()
    return found


def _libm_digest() -> str:
    """Digest of some sines, exponentials and powers: their last bits tell the code apart."""
    draw = random.Random(0)
    points = [draw.uniform(-3.0, 3.0) for _ in range(20_000)]
    values = [(math.sin(x), math.tan(x), math.exp(x), math.pow(abs(x), 1.7)) for x in points]
    return hashlib.sha256(repr(values).encode()).hexdigest()[:16]
