"""Arrow keys read values out of a slice, a slider changes a gain, buttons change the layer."""

import numpy as np
import pytest

from dualarm_repro.view.assets import ASSETS
from dualarm_repro.view.slices import Curve, Layer, curve_slice, map_slice

from ..browser import dumped, needs_browser

_ACTS = """
const press = (svg) => svg.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
document.querySelectorAll(".ledger-slice svg[tabindex]").forEach(press);
document.querySelectorAll(".slice-controls input").forEach((input) => {
  if (input.type === "radio") return input.value === "1" && input.click();
  input.value = 2;
  input.dispatchEvent(new Event("input"));
});
"""


@pytest.fixture(scope="module")
def page():
    x = np.array([1.0, 2.0, 3.0])
    curves = [Curve("sum", {"a": x, "b": x**2})]
    drawn = curve_slice("t", x, curves, x_label="s [m]", y_label="U", gains={"b": 1.0})
    layers = [Layer("low", np.eye(3), {}), Layer("high", 1.0 - np.eye(3), {})]
    plane = map_slice("m", ("x [m]", x), ("y [m]", x), layers, quantity="J", shown=0)
    script = (ASSETS / "slice.js").read_text(encoding="utf-8")
    acts = f"<script>onload = () => {{{_ACTS}}}</script>"
    return f"{drawn.html}{plane.html}<script>{script}</script>{acts}"


@needs_browser
def test_values_are_read_out(page, tmp_path):
    file = tmp_path / "page.html"
    file.write_text(f"<!DOCTYPE html><body>{page}", encoding="utf-8")
    html = dumped(file, tmp_path)
    assert "s 1 m: sum 3<" in html  # 1 + 2 * 1 after the slider moved
    assert "Shown: high." in html
    assert "x 3.000, y 2.000 m, high: J 1<" in html
