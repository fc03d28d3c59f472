"""Steps and the seed that the whole room uses."""

#: Entropy of everything random in this room.
SEED = 20240057
#: Rate of the controller, 1 kHz [s].
CONTROL_STEP = 1e-3
#: Step of runs that are repeated many times [s].
COARSE_STEP = 5e-3
