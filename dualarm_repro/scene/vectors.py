"""Three-vectors as tuples for compiled kernels: they live in registers and allocate nothing."""

from __future__ import annotations

from ..kernel import kernel


@kernel
def vector(row):
    """The first three numbers of an array as a tuple."""
    return row[0], row[1], row[2]


@kernel
def minus(a, b):
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@kernel
def along(a, s, u):
    """a + s u."""
    return a[0] + s * u[0], a[1] + s * u[1], a[2] + s * u[2]


@kernel
def scaled(s, u):
    """s u."""
    return s * u[0], s * u[1], s * u[2]


@kernel
def dot(a, b):
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a, b):
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel
def rotated(R, v):
    """R v for an array R whose first three columns are a rotation."""
    return (
        R[0, 0] * v[0] + R[0, 1] * v[1] + R[0, 2] * v[2],
        R[1, 0] * v[0] + R[1, 1] * v[1] + R[1, 2] * v[2],
        R[2, 0] * v[0] + R[2, 1] * v[1] + R[2, 2] * v[2],
    )


@kernel
def rotated_back(R, v):
    """R^T v for an array R whose first three columns are a rotation."""
    return (
        R[0, 0] * v[0] + R[1, 0] * v[1] + R[2, 0] * v[2],
        R[0, 1] * v[0] + R[1, 1] * v[1] + R[2, 1] * v[2],
        R[0, 2] * v[0] + R[1, 2] * v[1] + R[2, 2] * v[2],
    )


@kernel
def perpendicular(u):
    """Unit vector normal to u: u x e_k with k the smallest component of u; e_z when u = 0."""
    x, y, z = abs(u[0]), abs(u[1]), abs(u[2])
    if x <= y and x <= z:
        n = (0.0, u[2], -u[1])
    elif y <= z:
        n = (-u[2], 0.0, u[0])
    else:
        n = (u[1], -u[0], 0.0)
    length = dot(n, n) ** 0.5
    return scaled(1.0 / length, n) if length > 0.0 else (0.0, 0.0, 1.0)


@kernel
def into_frame(pose, p):
    """A world point in a frame with world pose ``pose``, the upper (3, 4) of its transform."""
    return rotated_back(pose, (p[0] - pose[0, 3], p[1] - pose[1, 3], p[2] - pose[2, 3]))


@kernel
def out_of_frame(pose, p):
    """A point of a frame with world pose ``pose`` (3, 4) in world coordinates."""
    x, y, z = rotated(pose, p)
    return x + pose[0, 3], y + pose[1, 3], z + pose[2, 3]
