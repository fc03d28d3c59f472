"""A title says what was found: the first sentence of a caption holds an obtained value."""

import pytest

from dualarm_repro.ledger import record
from dualarm_repro.ledger.finding import finding_of
from dualarm_repro.papers import load

#: Item, the obtained values that its title has to hold, and how they are written.
TITLES = {
    "patent.claim_faster": lambda o: [f"{o['sooner']['count']} of {o['sooner']['of']}"],
    "patent.claim_gain_time_varying": lambda o: ["sooner than", f"{o['ceiling']:g} 1/s"],
    "patent.fig01": lambda o: [f"{len(steps)} of" for steps in o["steps"]],
    "pan.fig03": lambda o: [f"{max(o['semi_axes'])[0]:.2f} m/s", f"{min(o['semi_axes'])[0]:.2f}"],
    "pan.fig04": lambda o: [f"{o['separation']:.3f} m"],
    "pan.fig14": lambda o: [f"{o['best_last']:.3f}", f"{o['mean_last']:.3f}"],
}


@pytest.mark.parametrize("item_id", TITLES)
def test_the_title_is_the_finding(item_id):
    made = record(load(), item_id)
    title, _ = finding_of(made["caption"])
    for text in TITLES[item_id](made["obtained"]):
        assert text in title


def test_the_growing_gain_is_sooner_only_where_it_is():
    made = record(load(), "patent.claim_gain_time_varying")
    title, _ = finding_of(made["caption"])
    assert ("not sooner" in title) == (made["obtained"]["sooner"] <= 0)
