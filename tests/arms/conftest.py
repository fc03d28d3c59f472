"""Arms and files shared by the tests of the room."""

import numpy as np
import pytest

#: A minimal two-link arm about z, y, y whose workspace is known in closed form.
TWO_LINKS = """\
kind: dh
title: two links
evidence: made up
sources: {{test: made up}}
convention: modified
joints:
  - {{name: j1, alpha: 0, a: 0, d: 0, offset: 0, lower: {q1[0]}, upper: {q1[1]}, velocity: 1}}
  - {{name: j2, alpha: "-pi/2", a: 0, d: 0, offset: 0, lower: {q2[0]}, upper: {q2[1]}, velocity: 1}}
  - {{name: j3, alpha: 0, a: {l1}, d: 0, offset: 0, lower: "-pi", upper: "pi", velocity: 1}}
flange: {{translation: [{l2}, 0, 0], rpy: [0, 0, 0], source: test, evidence: assumed}}
provenance:
  alpha: {{source: test, evidence: assumed}}
  a: {{source: test, evidence: assumed}}
  d: {{source: test, evidence: assumed}}
  offset: {{source: test, evidence: assumed}}
  lower: {{source: test, evidence: assumed}}
  upper: {{source: test, evidence: assumed}}
  velocity: {{source: test, evidence: assumed}}
"""


@pytest.fixture
def rng():
    return np.random.default_rng(20240501)


@pytest.fixture
def two_links(tmp_path):
    """A file with lengths l1, l2 [m] and ranges of joints 1 and 2 [rad or text]."""

    def write(l1=0.7, l2=0.4, q1=("-pi", "pi"), q2=("-pi", "pi")):
        path = tmp_path / "two-links.yaml"
        path.write_text(TWO_LINKS.format(l1=l1, l2=l2, q1=q1, q2=q2), encoding="utf-8")
        return path

    return write
