"""A frozen scenario in ``data/scenes``: two arms of one model and a circle per tip."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from ..arguments import checked
from ..datafiles import StrictModel, Text, read_yaml

Number = Annotated[float, Field(allow_inf_nan=False)]
Triple = tuple[Number, Number, Number]


class ArmStart(StrictModel):
    """Start of one arm and the plane and phase of its circle."""

    q: list[Number] = Field(min_length=1, description="start [rad]")
    normal: Triple = Field(description="of the plane of the circle")
    angle: Number = Field(description="of the start on the circle, within its plane [rad]")


class Found(StrictModel):
    """How the scenario was found."""

    seed: list[int]
    criteria: Text


class Scenario(StrictModel):
    """Two arms of one model, bases apart along y and looking along x, each tip on a circle."""

    kind: Literal["velocity-control"]
    title: Text
    robot: Text = Field(description="name in data/robots")
    base_distance: float = Field(gt=0, allow_inf_nan=False, description="[m]")
    radius: float = Field(gt=0, allow_inf_nan=False, description="of the circles [m]")
    duration: float = Field(gt=0, allow_inf_nan=False, description="of one turn [s]")
    left: ArmStart
    right: ArmStart
    found: Found


@checked
def load_scenario(path: Path) -> Scenario:
    """Read and check a scenario file.

    Raises
    ------
    DataFileError
        With the first offending field, its value and what was expected.
    """
    return Scenario.checked(path, read_yaml(path))


def json_schema() -> dict[str, Any]:
    """JSON Schema of a scenario file, for editors and other tools."""
    return Scenario.model_json_schema()
