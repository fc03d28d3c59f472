"""Kinematics of a serial chain as straight-line programs: T(q) = C_0 M(q_1) C_1 ... M(q_n) C_n.

M is Rz(q) with sine ``s1`` and cosine ``c1``, or Tz(q) with ``d1`` for a joint that slides.
"""

from __future__ import annotations

from typing import NamedTuple

from .program import ONE, ZERO, Program, Term, Vector
from .structure import Structure

_IDENTITY = ((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE))


class Frame(NamedTuple):
    """Rows of a rotation, and an origin."""

    rotation: tuple[Vector, Vector, Vector]
    origin: Vector

    @property
    def axis(self) -> Vector:
        """z."""
        return tuple(row[2] for row in self.rotation)


BASE = Frame(_IDENTITY, (ZERO, ZERO, ZERO))


def then(program: Program, frame: Frame, chain: Structure, index: int) -> Frame:
    """A frame times C_index."""
    rotation, translation = chain.rotations[index], chain.translations[index]
    columns = tuple(zip(*rotation, strict=True))
    turned = [tuple(program.inner(row, c) for c in columns) for row in frame.rotation]
    return Frame((turned[0], turned[1], turned[2]), place(program, frame, translation))


def place(program: Program, frame: Frame, point: Vector) -> Vector:
    """A point of the frame."""
    return tuple(
        program.plus(o, program.inner(row, point))
        for o, row in zip(frame.origin, frame.rotation, strict=True)
    )


def move(program: Program, frame: Frame, chain: Structure, joint: int) -> Frame:
    """A frame times M(q_joint), joints counted from 1."""
    if chain.slides[joint - 1]:
        return Frame(frame.rotation, place(program, frame, (ZERO, ZERO, Term(1, f"d{joint}"))))
    s, c = Term(1, f"s{joint}"), Term(1, f"c{joint}")
    rows = [
        (
            program.plus(program.times(x, c), program.times(y, s)),
            program.plus(program.times(y, c), -program.times(x, s)),
            z,
        )
        for x, y, z in frame.rotation
    ]
    return Frame((rows[0], rows[1], rows[2]), frame.origin)


def joint_frames(program: Program, chain: Structure, base: Frame = BASE) -> list[Frame]:
    """F_0 = base and F_j = F_(j-1) C_(j-1) M(q_j) for j = 1 ... n, and last the flange F_n C_n."""
    frames = [base]
    for joint in range(1, chain.joints + 1):
        before = then(program, frames[-1], chain, joint - 1)
        frames.append(move(program, before, chain, joint))
    return [*frames, then(program, frames[-1], chain, chain.joints)]


def pose(program: Program, chain: Structure) -> list[Term]:
    """T(q) row by row (4, 4)."""
    flange = joint_frames(program, chain)[-1]
    rows = zip(flange.rotation, flange.origin, strict=True)
    return [*(term for row, shift in rows for term in (*row, shift)), ZERO, ZERO, ZERO, ONE]


def position(program: Program, chain: Structure) -> list[Term]:
    """p(q) (3), from the flange back to the base: only one vector is turned."""
    point = chain.translations[-1]
    for joint in range(chain.joints, 0, -1):
        x, y, z = point
        if chain.slides[joint - 1]:
            moved: Vector = (x, y, program.plus(z, Term(1, f"d{joint}")))
        else:
            s, c = Term(1, f"s{joint}"), Term(1, f"c{joint}")
            moved = (
                program.plus(program.times(x, c), -program.times(y, s)),
                program.plus(program.times(x, s), program.times(y, c)),
                z,
            )
        frame = Frame(chain.rotations[joint - 1], chain.translations[joint - 1])
        point = place(program, frame, moved)
    return list(point)


def origins(program: Program, chain: Structure) -> list[Term]:
    """Origins of the joint frames 1 ... n and of the flange (n + 1, 3)."""
    return [term for frame in joint_frames(program, chain)[1:] for term in frame.origin]


def points(
    program: Program, chain: Structure, carried: tuple[tuple[int, Vector], ...]
) -> list[Term]:
    """Points (P, 3), each given in the frame of the joint that carries it; 0 is the base."""
    frames = joint_frames(program, chain)
    return [term for joint, local in carried for term in place(program, frames[joint], local)]


def jacobian(program: Program, chain: Structure) -> list[Term]:
    """Columns [z_j x (p - o_j); z_j], of a sliding joint [z_j; 0], row by row (6, n)."""
    *frames, flange = joint_frames(program, chain)
    return _rows(_columns(program, chain, frames[1:], flange.origin))


def manipulability(program: Program, chain: Structure) -> list[Term]:
    """w = sqrt(det(J J^T)) (1): of six joints |det J|, of more the product of the norms of
    J's orthogonalised rows.

    Both err by the round-off of products near singularities, where det(J J^T) would lose half of
    the digits (Yoshikawa 1985 for the measure). The measure depends neither on the point of the
    body nor on the axes: those of the joint are taken that leave the fewest operations.
    """
    if chain.joints < 6:
        return [ZERO]
    found = []
    for origin in range(1, chain.joints + 1):
        trial = Program()
        rows = _rows(_columns(trial, chain, *seen_from(trial, chain, origin)))
        found.append((len(trial.needed(_volume(trial, rows, chain.joints))), origin))
    _, origin = min(found)
    rows = _rows(_columns(program, chain, *seen_from(program, chain, origin)))
    return _volume(program, rows, chain.joints)


def seen_from(program: Program, chain: Structure, origin: int) -> tuple[list[Frame], Vector]:
    """Axes and origins of the joints 1 ... n in the frame F_origin before its own motion, and the
    origin of that frame."""
    frames = {origin: BASE}
    ahead = BASE
    for joint in range(origin, chain.joints):
        ahead = then(program, move(program, ahead, chain, joint), chain, joint)
        frames[joint + 1] = ahead
    behind = BASE
    for joint in range(origin - 1, 0, -1):
        # F_joint = F_(joint+1) C_joint^-1 M(q_joint)^-1, whose axis is that before the motion.
        R, t = chain.rotations[joint], chain.translations[joint]
        columns = tuple(zip(*R, strict=True))
        turned = [tuple(program.inner(row, r) for r in R) for row in behind.rotation]
        back = [-program.inner(c, t) for c in columns]
        behind = Frame((turned[0], turned[1], turned[2]), place(program, behind, tuple(back)))
        behind = _undo(program, behind, chain, joint)
        frames[joint] = behind
    return [frames[joint] for joint in range(1, chain.joints + 1)], BASE.origin


def _undo(program: Program, frame: Frame, chain: Structure, joint: int) -> Frame:
    """A frame times M(q_joint)^-1."""
    if chain.slides[joint - 1]:
        return Frame(frame.rotation, place(program, frame, (ZERO, ZERO, Term(-1, f"d{joint}"))))
    s, c = Term(1, f"s{joint}"), Term(1, f"c{joint}")
    rows = [
        (
            program.plus(program.times(x, c), -program.times(y, s)),
            program.plus(program.times(y, c), program.times(x, s)),
            z,
        )
        for x, y, z in frame.rotation
    ]
    return Frame((rows[0], rows[1], rows[2]), frame.origin)


def _columns(
    program: Program, chain: Structure, frames: list[Frame], point: Vector
) -> list[Vector]:
    """Of every joint its column of the Jacobian (6) at a point of the body of the flange."""
    columns = []
    for frame, slides in zip(frames, chain.slides, strict=True):
        if slides:
            columns.append((*frame.axis, ZERO, ZERO, ZERO))
            continue
        arm = tuple(program.plus(p, -o) for p, o in zip(point, frame.origin, strict=True))
        columns.append((*program.cross(frame.axis, arm), *frame.axis))
    return columns


def _rows(columns: list[Vector]) -> list[Term]:
    return [term for row in zip(*columns, strict=True) for term in row]


def _volume(program: Program, entries: list[Term], n: int) -> list[Term]:
    """Volume that the rows of a matrix (6, n) span."""
    rows = [entries[n * i : n * (i + 1)] for i in range(6)]
    if n == len(rows):
        return [_magnitude(program, _determinant(program, rows))]
    square_volume = ONE
    while rows:
        first = min(rows, key=_entries)
        rows.remove(first)
        square = program.inner(first, first)
        if not square.sign:
            return [ZERO]
        square_volume = program.times(square_volume, square)
        part = program.function("reciprocal", square)
        for k, row in enumerate(rows):
            along = program.times(program.inner(first, row), part)
            rows[k] = [
                program.plus(x, -program.times(along, y)) for x, y in zip(row, first, strict=True)
            ]
    return [program.function("sqrt", square_volume)]


def _determinant(program: Program, rows: list[list[Term]]) -> Term:
    """det of a square matrix up to its sign, expanded along its emptiest rows; every minor of the
    rows below is computed once."""
    rows = sorted(rows, key=_entries)
    minors: dict[tuple[int, ...], Term] = {(): ONE}

    def minor(columns: tuple[int, ...]) -> Term:
        if columns not in minors:
            row, total = rows[-len(columns)], ZERO
            for i, column in enumerate(columns):
                if row[column].sign:
                    rest = minor(columns[:i] + columns[i + 1 :])
                    part = program.times(row[column], rest)
                    total = program.plus(total, -part if i % 2 else part)
            minors[columns] = total
        return minors[columns]

    return minor(tuple(range(len(rows))))


def _entries(row: list[Term]) -> int:
    """Number of entries that are not 0."""
    return sum(1 for term in row if term.sign)


def _magnitude(program: Program, a: Term) -> Term:
    return program.function("abs", Term(1, a.name)) if a.name else Term(abs(a.sign))
