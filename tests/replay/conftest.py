"""The items that are replayed, exported once for all of them."""

import pytest
from exported import Export

ITEMS = (
    "xue.eq02", "xue.eq03", "xue.eq04", "xue.eq05", "xue.eq06", "xue.eq07", "xue.claim_gains",
    "xue.claim_master_start", "xue.claim_master_goal", "xue.claim_slave_start",
    "xue.claim_slave_end", "xue.fig08", "xue.fig09", "xue.fig10", "xue.fig11", "xue.eq16",
    "xue.tab02", "xue.claim_only_tcp",
    "qiu.claim_bases", "qiu.claim_obstacles", "qiu.claim_start", "qiu.claim_d", "qiu.claim_zeta",
    "qiu.claim_rho0", "qiu.claim_alpha0", "qiu.claim_goals15", "qiu.claim_no_collision",
    "qiu.eq04", "qiu.fig03", "qiu.fig10", "qiu.fig12", "qiu.fig17", "qiu.tab02",
    "patent.fig02", "patent.claim_accuracy", "patent.claim_limits", "patent.claim_two_ranges",
    "patent.eq_integration",
    "pan.tab_none", "pan.fig10", "pan.claim_bases", "pan.claim_optimum", "pan.fig06", "pan.fig16",
    "pan.claim_joint_sequence", "pan.claim_constraints",
)  # fmt: skip


@pytest.fixture(scope="session")
def files(tmp_path_factory):
    """The folder with what the command line writes of all items."""
    return Export.of(ITEMS, tmp_path_factory.mktemp("published")).folder
