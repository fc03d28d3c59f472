"""Arms whose lengths differ by round-off from those of their files, for what hangs on that."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..arms.chain import Chain, SlidingChain


def nudge_arms(seed: int) -> None:
    """Change every length of every arm that this process loads from now on by an ulp or so.

    Lengths become l (1 + 4e-16 s) with s = -1 or 1 drawn with ``seed``, less than a robot file
    could say. Meant for a process of its own: nothing takes it back.
    """
    import numpy as np

    from ..arms import arm

    exact, rng = arm.chain_of, np.random.default_rng(seed)

    def nudged(name: str, model: Any, flange: int) -> Chain | SlidingChain:
        chain = exact(name, model, flange)
        signs = rng.choice((-1.0, 1.0), chain.translation.shape)
        return chain._replace(translation=chain.translation * (1.0 + 4e-16 * signs))

    arm.chain_of = nudged
