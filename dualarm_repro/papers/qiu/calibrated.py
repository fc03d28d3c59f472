"""The two readings of `qiu` that are drawn beside each other: face value and calibrated.

A calibrated reading is the one of the declared fits (:mod:`.studies.fit` of the master,
:mod:`.studies.fit_slave` of the slave) that needs the printed number of searches and comes nearest
to the printed meeting points. It is fitted to printed results and predicts none of them.
"""

from __future__ import annotations

from ...planning.search.dual_search import DualSearch
from ...planning.search.search_plan import SearchPlan
from ...tracking import memo
from .document import CALIBRATED, FACE_VALUE
from .reading import Search, Slave
from .studies.fit import calibrated_master
from .studies.fit_slave import calibrated_slave


def readings(reading: Search) -> dict[str, SearchPlan]:
    """The search of a reading of the master, and the same kind of search as calibrated."""
    return {FACE_VALUE: reading.plan(), CALIBRATED: calibrated_master(type(reading)).plan()}


def dual_readings(reading: Slave) -> dict[str, DualSearch]:
    """Both arms by one reading, and each as calibrated for its own run."""
    return {FACE_VALUE: reading.dual_plan(), CALIBRATED: calibrated_pair()}


@memo()
def calibrated_pair() -> DualSearch:
    """Master and slave, each by the reading that is calibrated for its own run."""
    slave = calibrated_slave()
    return slave.around(calibrated_master(Slave).plan(), slave.slave_posture())
