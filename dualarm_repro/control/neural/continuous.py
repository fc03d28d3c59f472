"""The network as one stiff differential equation of robot and state, as its text gives it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from ...arguments import Joints, checked
from ...errors import InputError, UnknownNameError
from ..assembly import make_buffers, sense
from ..circle import Circles, follow
from ..closed_loop import observe
from ..motion import Motion
from ..settings import ControllerSettings
from ..simulate import checked_run, require_states
from ..system import ArmSystem
from .network import state_rate
from .network_settings import NetworkSettings

INTEGRATORS = {"bdf": "BDF", "radau": "Radau", "rk45": "RK45"}
#: Tolerances and largest step [s] of related public code.
RELATIVE, ABSOLUTE, LONGEST = 1e-6, 1e-8, 0.05
_EXACT_READING = np.empty(0)


@checked
def integrate_network(
    system: ArmSystem,
    circles: Circles,
    q0: ArrayLike,
    settings: ControllerSettings,
    network: NetworkSettings,
    *,
    integrator: str = "bdf",
    sample: float = 5e-3,
    y0: Joints | None = None,
) -> tuple[Motion, int]:
    """Integrate d[q; y]/dt = [x; dy/dt] over one turn of the circles, with the gain unlimited.

    Parameters
    ----------
    integrator : str
        Of :data:`INTEGRATORS`.
    sample : float
        Step of the samples returned [s].
    y0 : (n + m,), optional
        State of the network at the start; default 0.

    Returns
    -------
    Motion, int
        Samples, and how often the right-hand side was evaluated.

    Raises
    ------
    ConfigurationError, InputError, UnknownNameError
        Bad arguments.
    """
    if integrator not in INTEGRATORS:
        raise UnknownNameError(
            "integrate_network", "integrator", integrator, f"one of {', '.join(INTEGRATORS)}"
        )
    if network.integral:
        raise InputError("integrate_network", "integral", network.integral, "0, without integral")
    q0, numbers, steps = checked_run(system, circles, q0, settings, sample, 1)
    arrays, circle, numbered = system.arrays, circles.numbers(), network.numbers()
    n, m = system.nq, 3 * len(system.arms)
    buffers = make_buffers(arrays, numbers)
    undisturbed = np.zeros(n + m)

    def rate(t: float, z: np.ndarray) -> np.ndarray:
        dz = np.empty(n + n + m)
        q, y = z[:n].copy(), z[n:].copy()
        moved = (q, q0, t, y, _EXACT_READING, undisturbed)
        state_rate(arrays, numbers, numbered, circle, *moved, buffers, dz[n:])
        dz[:n] = y[:n]
        return dz

    times = sample * np.arange(steps + 1)
    y0 = np.zeros(n + m) if y0 is None else y0
    require_states("integrate_network", system, y0=y0)
    found = solve_ivp(
        rate,
        (0.0, times[-1]),
        np.concatenate([q0, y0]),
        method=INTEGRATORS[integrator],
        t_eval=times,
        rtol=RELATIVE,
        atol=ABSOLUTE,
        max_step=LONGEST,
    )
    q, x = found.y[:n].T, found.y[n : 2 * n].T
    error, distance, rows = np.empty((len(q), len(system.arms))), np.empty(len(q)), []
    position, velocity = np.empty((2, len(system.arms), 3))
    for k, t in enumerate(found.t):
        rows.append(sense(arrays, numbers, np.ascontiguousarray(q[k]), _EXACT_READING, buffers))
        follow(circle, t, position, velocity)
        distance[k] = observe(buffers, position, error[k])
    stopped = None if found.success else f"{found.message} at t = {found.t[-1]:.3f} s"
    counts, given = np.array(rows[:-1]), np.zeros(len(q) - 1)
    looks = found.t, q, x[:-1], error, distance, counts, given
    motion = Motion(sample, *looks, system.limits, stopped)
    return motion, int(found.nfev)
