"""Names of values in words: what the ledger calls ``mean_time`` a reader calls mean time."""

from __future__ import annotations

import re

_GREEK = {
    "alpha": "α", "beta": "β", "delta": "δ", "zeta": "ζ", "eta": "η", "theta": "θ", "kappa": "κ",
    "lambda": "λ", "mu": "μ", "rho": "ρ", "sigma": "σ", "tau": "τ", "gamma": "γ", "omega": "ω",
}  # fmt: skip
_PHRASES = {
    "tcp": "tool centre point",
    "q": "joint angles",
    "C": "C",
    "X_dot": "X_dot",
    "Q_dot": "Q_dot",
    "rows": "rows",
    "centres": "centres of the spheres",
    "steps": "steps in order",
    "details": "claim",
    "over": "over the variables",
    "subject_to": "subject to",
    "axes": "semi-axes",
    "gradient": "gradient",
}
_LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def phrase(key: str) -> str:
    """A key of the ledger in words; Greek letters as such, with their index."""
    if key in _PHRASES:
        return _PHRASES[key]
    stem, _, index = key.partition("_")
    if not index and (found := re.fullmatch(r"([a-z]+)(\d)", key)):
        stem, index = found[1], found[2]
    if stem in _GREEK:
        low = index.translate(_LOW) if index.isdigit() else f"_{index}" if index else ""
        return _GREEK[stem] + low
    if len(stem) == 1 and index and len(index) < 3:
        return key
    if index.isdigit():
        return f"{stem} {index}"
    return key.replace("_", " ")
