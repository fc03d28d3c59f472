"""3-D scenes draw something, seen in their pixels, and those that carry a motion move."""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.async_api import BrowserContext, Locator

from .report import Report
from .visit import visit

SCENES = "figure.ledger-scene"
#: A small screen, since scenes are drawn without a graphics card here.
STAGE = {"width": 400, "height": 400}
#: Share of the pixels of a scene that have to be coloured or dark; ground and grid are pale greys.
LEAST_DRAWN = 0.005
#: A pixel is coloured if its channels are so far apart, of 255, and dark if none is brighter.
COLOURED, DARK = 60, 128
#: Milliseconds between two looks, and looks until a scene counts as still or blank.
APART, LOOKS = 400, 40
_SPARED = """(() => {
  const get = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, options) {
    const kept = { ...options, preserveDrawingBuffer: true, antialias: false };
    return get.call(this, kind, kind.startsWith("webgl") ? kept : options);
  };
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 333);
})();"""
_PIXELS = """(canvas) => {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const on = copy.getContext("2d");
  on.fillStyle = "#fff";
  on.fillRect(0, 0, copy.width, copy.height);
  on.drawImage(canvas, 0, 0);
  return copy.toDataURL("image/png");
}"""


async def spare(context: BrowserContext) -> None:
    """Let scenes be read after they were drawn, and draw three pictures a second, rough edges and
    all: without a graphics card a scene would otherwise keep the machine busy."""
    await context.add_init_script(_SPARED)


async def look_at_scenes(context: BrowserContext, html: Path, name: str, report: Report) -> int:
    """Check every scene of a page; the number of those that move.

    Parameters
    ----------
    context
        One that is prepared by :func:`spare`.
    """
    moving = 0
    async with visit(context, html / f"{name}.html") as made:
        scenes = made.page.locator(SCENES)
        for number in range(await scenes.count()):
            scene, lines = scenes.first, []
            await scene.evaluate("(one) => one.scrollIntoView({block: 'center'})")
            await scene.locator("button.scene-start").click()
            if not await _until(scene, drawn):
                lines.append(f"scene {number + 1} draws nothing")
            elif await scene.get_attribute("data-moves") == "yes":
                first = pixels(await picture(scene))
                play = scene.get_by_role("button", name="Play", exact=True)
                if await play.count():  # else it plays since it was started
                    await play.click()
                moves = await _until(scene, lambda now, first=first: differs(first, now))
                moving += moves
                lines += [] if moves else [f"scene {number + 1} has a motion and stands still"]
            report.add("scenes", name, lines)
            await scene.evaluate("(one) => one.remove()")  # it would go on drawing
    return moving


async def picture(scene: Locator) -> str:
    """What a scene has drawn as a ``data:`` address; empty while it has no canvas."""
    canvas = scene.locator("canvas")
    return await canvas.first.evaluate(_PIXELS) if await canvas.count() else ""


def pixels(address: str) -> np.ndarray:
    """Pixels (height, width, 3) of a picture, one white pixel if there is none."""
    data = b64decode(address.partition(",")[2])
    if not data:
        return np.full((1, 1, 3), 255)
    return np.asarray(Image.open(BytesIO(data)).convert("RGB")).astype(int)


def drawn(found: np.ndarray) -> bool:
    """Whether there is more than an empty stage."""
    brightest = found.max(axis=2)
    seen = (brightest - found.min(axis=2) > COLOURED) | (brightest < DARK)
    return float(seen.mean()) >= LEAST_DRAWN


def differs(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether something has moved from one picture to another."""
    if first.shape != second.shape:
        return False
    return float((np.abs(first - second).max(axis=2) > COLOURED).mean()) > 1e-4


async def _until(frame: Locator, holds: Callable[[np.ndarray], bool]) -> bool:
    for _ in range(LOOKS):
        if holds(pixels(await picture(frame))):
            return True
        await frame.page.wait_for_timeout(APART)
    return False
