"""What the foundations pages show: computed, right, and sensitive to errors."""

import re

import numpy as np
import pytest
import sympy as sp
from bs4 import BeautifulSoup
from hypothesis import given
from hypothesis import strategies as st
from long_tests import long_where

from dualarm_repro import load_arm
from dualarm_repro.arms import Arm, dh
from dualarm_repro.arms.angle import Angle
from dualarm_repro.arms.robot_file import load_robot_file
from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import UnknownNameError, UnsupportedArmError
from dualarm_repro.view import document, item_table
from dualarm_repro.view.equations import Equations, latex
from dualarm_repro.view.foundations import (
    agreement,
    conventions,
    distances,
    manipulability,
    workspace,
)

Q1, Q2, Q3 = dh.joint_symbols(3)


@pytest.fixture
def rng():
    return np.random.default_rng(0)


@pytest.fixture(scope="module")
def irb120():
    return load_arm("irb120")


def robot(name):
    return load_robot_file(data_path("robots", f"{name}.yaml"))


def caption(page):
    """The title of the figure, which is the first sentence, and the text below it."""
    title = re.search('<p class="ledger-finding">(.*?)</p>', page.html, re.DOTALL)[1]
    rest = re.search("<figcaption>(.*?)</figcaption>", page.html, re.DOTALL)
    return f"{title}. {rest[1] if rest else ''}"


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (sp.cos(Q2 + Q3), "c_{23}"),
        (-sp.sin(Q1) * sp.Rational("1.024"), "- 1.024 s_{1}"),
        (sp.cos(Q1) ** 2, "c_{1}^{2}"),
        (sp.cos(Q2 - Q3), r"\cos{\left(q_{2} - q_{3} \right)}"),
        (sp.Rational(1, 3) * Q1, r"\frac{q_{1}}{3}"),
        (sp.Integer(7), "7"),
    ],
)
def test_latex_uses_the_shorthand_of_the_field(expression, expected):
    assert latex(expression) == expected


@given(st.decimals(min_value="0.001", max_value="9.999", places=3))
def test_latex_keeps_every_digit_of_a_length(length):
    assert float(latex(sp.Rational(str(length)))) == float(length)


def test_equations_are_one_aligned_block():
    text = Equations({"a": sp.Integer(1), "b": sp.eye(2)})._repr_latex_()
    assert text.startswith(r"$$\begin{aligned} a &= 1 \\")
    assert text.count("&=") == 2


def test_displayed_link_transforms_are_those_of_a_table(irb120):
    shown = conventions.link_transforms()._sides
    theta, d = sp.symbols(r"\theta_i d_i", real=True)
    for label, name, suffix in (("A_i", "irb120", "i"), ("T_i", "es165d", "{i-1}")):
        joint = robot(name).joints[1]
        a, alpha = sp.symbols(rf"a_{suffix} \alpha_{suffix}", real=True)
        values = {
            theta: 0.3 + float(joint.offset),
            d: joint.d,
            a: joint.a,
            alpha: float(joint.alpha),
        }
        table = load_arm(name).link_transforms()[1].subs(Q2, 0.3)
        difference = np.array(shown[label].subs(values) - table, dtype=float)
        assert np.abs(difference).max() < 1e-12


@pytest.mark.parametrize(
    ("a", "alpha"), long_where(lambda last: last[1] == 0, [(0.0, 0), (0.1, 0), (0.05, "pi/3")])
)
def test_other_convention_is_the_same_arm(a, alpha, rng):
    table = robot("irb120")
    last = table.joints[-1].model_copy(update={"a": a, "alpha": Angle.parse(alpha)})
    standard = table.model_copy(update={"joints": [*table.joints[:-1], last]})
    modified = conventions.in_modified_convention(standard)
    same, other = Arm.from_dh("a", standard), Arm.from_dh("b", modified)
    q = same.random_configurations(100, rng)
    assert np.abs(same.fk(q) - other.fk(q)).max() < 1e-12
    misread = Arm.from_dh("c", conventions.lengths_misread(standard, modified))
    assert np.abs(same.fk(q) - misread.fk(q)).max() > 0.05


def test_only_a_standard_table_can_be_moved():
    with pytest.raises(UnsupportedArmError, match="not a standard table"):
        conventions.in_modified_convention(robot("es165d"))


def test_frames_page_states_the_residual(rng):
    assert "identically zero" in caption(conventions.frames_page("irb120", rng))


@pytest.mark.parametrize("name", ["irb120", "es165d"])
def test_three_ways_agree(name, rng):
    arm = load_arm(name)
    table = agreement.three_ways(arm, arm.random_configurations(50, rng))
    assert table.shape == (3, 2)
    assert (table < 1e-13).all(axis=None)


def test_three_ways_see_a_wrong_jacobian(irb120, rng, monkeypatch):
    true = Arm.jacobian
    monkeypatch.setattr(
        Arm, "jacobian", lambda self, q: true(self, q) * (1.0 + 1e-9 * (q.ndim == 2))
    )
    table = agreement.three_ways(irb120, irb120.random_configurations(50, rng))
    assert table.loc["Pinocchio − batch kernel", "Jacobian"] > 1e-10
    assert table.loc["sympy − Pinocchio", "Jacobian"] < 1e-13


def test_finite_differences_have_the_order_of_their_scheme(irb120, rng):
    errors = agreement.finite_differences(irb120, irb120.random_configurations(50, rng))
    coarse = errors[errors.index > 1e-3]
    slopes = np.log10(coarse.iloc[-1] / coarse.iloc[0]) / np.log10(
        coarse.index[-1] / coarse.index[0]
    )
    # an order read off two steps; higher orders still weigh at the larger one
    assert slopes["forward"] == pytest.approx(1.0, abs=0.1)
    assert slopes["central"] == pytest.approx(2.0, abs=0.1)  # as above
    assert errors["central"].min() < 1e-9
    assert "Central differences come within" in caption(
        agreement.finite_differences_page(irb120, irb120.random_configurations(5, rng))
    )


def test_closed_forms_agree_with_coal(rng):
    table = distances.agreement_with_coal(200, rng)
    assert table["largest difference [m]"].max() < 1e-9
    assert (table["penetrating"] > 0.05).all()


def test_field_page_states_the_error_of_the_gradient(rng, monkeypatch):
    monkeypatch.setattr(distances, "_POINTS", 50)
    error = float(re.search(r"by at most (\S+)\. On", caption(distances.field_page(rng)))[1])
    assert error < 1e-7


def test_crease_page_finds_the_switch_and_the_jumps():
    text = caption(distances.crease_page())
    before, after = map(float, re.search(r"from ([+-]\S+) to ([+-]\S+) m/rad", text).groups())
    assert before > 0 > after
    assert "adds 2 jumps" in text
    assert float(re.search(r"by at most (\S+)\.$", text)[1]) < 1e-6


@pytest.mark.parametrize("name", ["irb120", "es165d", "irb2400"])
def test_factors_of_the_manipulability(name, rng):
    arm = load_arm(name)
    assert manipulability.factors_residual(arm, arm.random_configurations(50, rng)) < 1e-12


def test_factors_vanish_where_the_arm_is_singular(irb120):
    factors = manipulability.singular_factors(irb120)
    assert factors["wrist"].subs(dh.joint_symbols(6)[4], 0) == 0
    assert factors["shoulder"].free_symbols == set(dh.joint_symbols(6)[1:3])


def test_factors_need_a_table():
    with pytest.raises(UnsupportedArmError):
        manipulability.singular_factors(load_arm("ur5"))


def test_map_shows_the_best_branch(irb120):
    q, measure = manipulability._best(irb120, np.array([0.4, 2.0]), np.array([0.3, 0.0]))
    assert np.isnan(measure[1])
    pose = irb120.fk(q[0])
    assert pose[:3, 3] == pytest.approx([0.4, 0.0, 0.3], abs=1e-9)
    others = irb120.manipulability(irb120.ik(pose))
    assert measure[0] == pytest.approx(others.max(), rel=1e-9)
    page = manipulability.map_page(irb120, (0.1, 0.6, 0.0, 0.6), columns=17)
    assert 'alt="Map of the manipulability' in page.html


def test_cloud_page_holds_a_scene(irb120, rng):
    assert 'class="ledger-scene"' in workspace.cloud_page(irb120, rng).html


def test_document_pages(registry, monkeypatch):
    def bare_record(registry, item_id):
        item = registry.item(item_id)
        page = registry.checkers[item_id].page
        texts = {"pending": "<b>", "caption": None, "verdict": "undecidable", "obtained": None}
        texts |= {"robustness": None, "decided_by": None, "change": None, "checks": []}
        texts |= {
            "page": page,
            "url": f"{page}.html#{item_id}",
            "printed": item.printed,
            "unit": item.unit,
        }
        return texts | {"id": item_id, "paper": item_id.partition(".")[0], "kind": item.kind,
                        "title": item.title, "place": item.place, "witnesses": []}  # fmt: skip

    def bare_erratum(registry, erratum_id):
        proof = (
            {"statement": "s", "holds": True, "values": {}}
            if erratum_id in registry.proofs
            else None
        )
        return registry.errata[erratum_id].model_dump() | {"id": erratum_id, "proof": proof}

    monkeypatch.setattr(item_table, "record", bare_record)
    monkeypatch.setattr(document, "erratum_record", bare_erratum)
    for name, paper in registry.papers.items():
        assert document.document_page(registry, name).html.count("<dt>") >= 3
        assert document.items_page(registry, name).html.count("<details ") == len(paper.items)
        errata = document.errata_page(registry, name).html
        assert errata.count("<li id=") == len(paper.errata)
        if "No machine proof" in errata:  # what is proved comes first
            assert errata.find("No machine proof") > errata.rfind("<b>Proved</b>")
        told = BeautifulSoup(document.bibliography_page(registry).html, "html.parser").get_text()
        assert all(word in told for word in re.findall(r"\w+", paper.document.title)[:3])
    table = document.items_page(registry, "xue").html
    assert '"../xue/kinematics.html#xue.tab01"' in table
    assert "&lt;b&gt;" in table
    with pytest.raises(UnknownNameError, match="one of " + ", ".join(registry.documents)):
        document.errata_page(registry, "nobody")
