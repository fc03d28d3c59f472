"""`xue` recomputed from its exported files alone: clearances, forces, Table 2."""

import numpy as np
import pytest
from chains import Chain
from descents import Field, descend
from exported import Export, columns, number
from fields import Boxes, to_points
from replayed_arm import segment_distance

MATRICES = [f"xue.eq0{k}" for k in range(2, 8)]
SLAVE_ENDS = ("xue.claim_slave_start", "xue.claim_slave_end")
FIGURES = ("xue.fig08", "xue.fig09", "xue.fig10", "xue.fig11")
POINTS = range(2, 7)  # frames of the five distances of (15)


@pytest.fixture(scope="module")
def xue(files):
    return Export(files)


@pytest.fixture(scope="module")
def matrices(xue):
    return [xue.record(item_id)["printed"]["matrix"] for item_id in MATRICES]


@pytest.fixture(scope="module")
def layout(xue):
    return xue.assumed("xue.fig11")


def chains(matrices, layout):
    """Master and slave on their bases."""
    base = np.array([layout[f"master_base_{axis}"] for axis in "xyz"])
    beside = base - [0.0, layout["base_distance"], 0.0]
    return Chain.of_cells(matrices, base), Chain.of_cells(matrices, beside, mirror=-1.0)


def window(layout, ends):
    """The four bars."""
    chord = np.append((ends[1] - ends[0])[:2], 0.0)
    normal = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "chord": chord}[layout["window_normal"]]
    centre = [layout[f"window_centre_{axis}"] for axis in "xyz"]
    opening = layout["window_opening_width"], layout["window_opening_height"]
    return Boxes.window(centre, normal, opening, layout["window_bar"])


def printed_ends(xue):
    return [np.array([number(t) for t in xue.record(i)["printed"]["position"]]) for i in SLAVE_ENDS]


def printed_gains(xue):
    return {name: number(text) for name, text in xue.record("xue.claim_gains")["printed"].items()}


def joints(table, prefix="", suffix=""):
    return columns(table, *(f"{prefix}q{j}{suffix}" for j in range(1, 7)))


def test_clearance_of_the_master_in_figure_8(xue, matrices, layout):
    table, (master, _) = xue.table("xue.fig08"), chains(matrices, layout)
    bars = window(layout, printed_ends(xue))
    start, goal = (
        [number(t) for t in xue.record(f"xue.claim_master_{end}")["printed"]["q"]]
        for end in ("start", "goal")
    )
    path = joints(table)
    np.testing.assert_allclose(path[0], start, atol=1e-12)
    assert np.abs(path[-1] - goal).max() <= layout["goal_tolerance"]
    nearest = np.array([bars.distances(master.origins(q, POINTS))[0].min(axis=1) for q in path])
    recorded = columns(table, *(f"clearance frame_{k}" for k in POINTS))
    np.testing.assert_allclose(nearest, recorded, atol=1e-9)
    assert nearest.min() == pytest.approx(xue.obtained("xue.fig08")["distance"], rel=1e-5)


@pytest.mark.parametrize("figure", FIGURES[1:])
def test_clearances_of_the_slave_in_figures_9_to_11(xue, matrices, layout, figure):
    table, found = xue.table(figure), xue.obtained(figure)
    arms, bars = chains(matrices, layout), window(layout, printed_ends(xue))
    tips = {}
    for name, chain in zip(("master", "slave"), arms, strict=True):
        tips[name] = np.array([chain.origins(q, [6])[0] for q in joints(table, f"{name}_", "_rad")])
        np.testing.assert_allclose(
            tips[name], columns(table, *(f"{name}_{axis}_m" for axis in "xyz")), atol=1e-9
        )
    moving = found["steps"] + 1 if figure == "xue.fig09" else None
    apart = np.linalg.norm(tips["master"] - tips["slave"], axis=1)[:moving]
    to_bars = bars.distances(tips["slave"])[0].min()
    assert apart.min() == pytest.approx(found["flanges_apart"], rel=1e-5)
    assert to_bars == pytest.approx(found["flange_window"], rel=1e-5)


def links(chain, q):
    """Ends of the five links that have a length (5, 2, 3) [m]: the fourth begins where the arm of
    frame 4 leaves the elbow, at the foot of its origin on x of frame 3."""
    made, places = chain.frames(q), chain.origins(q, range(7))
    offset = np.linalg.inv(made[3]) @ made[4][:, 3]
    elbow = (made[3] @ [offset[0], 0.0, 0.0, 1.0])[:3] * [1.0, chain.mirror, 1.0] + chain.base
    ends = [(places[1], places[2]), (places[2], places[3]), (places[3], elbow),
            (elbow, places[4]), (places[5], places[6])]  # fmt: skip
    return np.array(ends)


LINK_NAMES = [f"capsule_{k}_joint_{joint}" for k, joint in enumerate((1, 2, 3, 4, 6))]


def test_whole_links_of_the_two_arms(xue, matrices, layout):
    """Every pair of links at every step of Fig. 11, and the smallest, with and without the tips."""
    motion, recorded = xue.table("xue.fig11"), xue.table("xue.claim_only_tcp")
    ends = [
        [links(chain, q) for q in joints(motion, f"{name}_", "_rad")]
        for name, chain in zip(("master", "slave"), chains(matrices, layout), strict=True)
    ]
    found = np.array([
        [[segment_distance(*one, *other) for other in slave] for one in master]
        for master, slave in zip(*ends, strict=True)
    ])  # fmt: skip
    for i, first in enumerate(LINK_NAMES):
        for k, second in enumerate(LINK_NAMES):
            there = recorded[f"master/{first} - slave/{second}"]
            np.testing.assert_allclose(found[:, i, k], there, atol=1e-6)
    obtained = xue.obtained("xue.claim_only_tcp")
    assert found.min() == pytest.approx(obtained["nominal"]["arms"], abs=1e-6)
    found[:, -1, -1] = np.inf
    assert found.min() == pytest.approx(obtained["nominal_other_links"], abs=1e-6)
    touching = 0.5 * found.min() <= xue.assumed("xue.claim_only_tcp")["link_radius"]
    assert touching == obtained["links_collide"]


def test_whole_links_and_the_window(xue, matrices, layout):
    """The distance to a box is convex along a link, so that its least is found by thirds."""
    motion, obtained = xue.table("xue.fig11"), xue.obtained("xue.claim_only_tcp")
    bars = window(layout, printed_ends(xue))
    for name, chain in zip(("master", "slave"), chains(matrices, layout), strict=True):
        ends = np.concatenate([links(chain, q) for q in joints(motion, f"{name}_", "_rad")])
        nearest = min(to_bar.min() for to_bar in along(bars, ends))
        assert nearest == pytest.approx(obtained["nominal"][f"{name}_window"], abs=1e-6)


def along(bars, ends):
    """Least distance of every link (N, 2, 3) to each bar in turn, (N,) [m]."""
    start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    count = bars.distances(start)[0].shape[1]
    for bar in range(count):
        low, high = np.zeros(len(ends)), np.ones(len(ends))
        for _ in range(60):
            first, second = low + (high - low) / 3, high - (high - low) / 3
            one, two = (
                bars.distances(start + s[:, None] * way)[0][:, bar] for s in (first, second)
            )
            low, high = np.where(one > two, first, low), np.where(one > two, high, second)
        yield bars.distances(start + low[:, None] * way)[0][:, bar]


def test_forces_at_a_hundred_postures(xue, matrices):
    table, window_ = xue.table("xue.eq16"), xue.obtained("xue.eq16")["window"]
    bars = Boxes.window(window_["centre"], (1.0, 0.0, 0.0), window_["opening"], window_["bar"])
    goal = np.array([number(t) for t in xue.record("xue.claim_master_goal")["printed"]["q"]])
    field = Field(Chain.of_cells(matrices), goal, tuple(POINTS), 1.0, bars, np.empty(0),
                  printed_gains(xue))  # fmt: skip
    q = joints(table, suffix="_rad")
    assert len(q) == 100
    found = [field.value_and_gradient(row, 0, False) for row in q]
    np.testing.assert_allclose([value for value, _ in found], table["U"], rtol=1e-9)
    forces = columns(table, *(f"tau{j}" for j in range(1, 7)))
    np.testing.assert_allclose(-np.array([g for _, g in found]), forces, rtol=1e-8, atol=1e-8)


def test_table_2(xue, matrices, layout):
    assumed, found = xue.assumed("xue.tab02"), xue.obtained("xue.tab02")
    assert assumed["master_as_obstacle"] == "joint_points"
    assert assumed["equal_speed_meaning"] == "same_step"
    master, slave = chains(matrices, layout)
    track = np.array([master.origins(q, POINTS) for q in joints(xue.table("xue.fig08"))])
    start, goal = (np.array(xue.obtained(item_id)["q"]) for item_id in SLAVE_ENDS)
    bars, gains = window(layout, printed_ends(xue)), printed_gains(xue)
    centre = np.array([layout[f"window_centre_{axis}"] for axis in "xyz"])
    assert assumed["success_criterion"] == "position"
    rng, width = np.random.default_rng(assumed["trial_seed"]), assumed["trial_perturbation"]
    starts = clear_starts(slave, bars, start, width, rng)
    settings = {
        "step_limit": assumed["step_limit"], "threshold": assumed["stuck_threshold"],
        "release": assumed["virtual_release"], "tolerance": assumed["goal_tolerance"],
        "gain": assumed["step_gain"], "max_step": assumed["max_step"],
    }  # fmt: skip
    at_the_tool, points = assumed["classical_method"] == "end_effector", tuple(POINTS)
    fields = {
        "traditional": ((6,) if at_the_tool else points, 0.0, None),
        "improved": (points, assumed["joint_term_weight"], centre),
    }
    missed = {}
    for name, (frames, weight, virtual) in fields.items():
        field = Field(slave, goal, frames, weight, bars, track, gains, virtual)
        missed[name] = sum(not descend(field, begin, settings)[0] for begin in starts)
    assert missed == {name: found["missed"][name] for name in missed}


def clear_starts(slave, bars, start, width, rng):
    """Ten starts around one, of which no point touches a bar, from blocks of ten."""
    found = []
    while len(found) < 10:
        for q in start + rng.uniform(-width, width, (10, 6)):
            if bars.distances(slave.origins(q, POINTS))[0].min() > 0.0 and len(found) < 10:
                found.append(q)
    return np.array(found)


def test_a_changed_file_is_noticed(matrices, layout, xue):
    table = xue.table("xue.fig08")
    bars, (master, _) = window(layout, printed_ends(xue)), chains(matrices, layout)
    q = joints(table)[40] + 1e-6
    recorded = table["clearance frame_6"][40]
    assert abs(bars.distances(master.origins(q, [6]))[0].min() - recorded) > 1e-9
    assert to_points(np.zeros((1, 3)), np.array([[3.0, 4.0, 0.0]]))[0][0, 0] == 5.0
