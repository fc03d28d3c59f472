"""3-D scenes draw something, seen in their pixels, and those that carry a motion move."""

from __future__ import annotations

import re
from base64 import b64decode
from binascii import Error
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.async_api import BrowserContext, Locator

from .report import Report
from .visit import visit

SCENES = "iframe.ledger-scene"
#: Share of the pixels of a scene that have to be coloured; ground and grid are grey and pale.
LEAST_DRAWN = 0.005
#: A pixel is coloured if its channels are so far apart, of 255.
COLOURED = 60
#: Milliseconds between two looks, and looks until a scene counts as still or blank.
APART, LOOKS = 400, 40
_COMMAND = re.compile(r'"([A-Za-z0-9+/]{8,}={0,2})"')


async def look_at_scenes(context: BrowserContext, html: Path, name: str, report: Report) -> int:
    """Check every scene of a page; the number of those that move."""
    moving = 0
    async with visit(context, html / f"{name}.html") as made:
        frames = made.page.locator(SCENES)
        for number in range(await frames.count()):
            frame = frames.nth(number)
            await frame.scroll_into_view_if_needed()
            lines = []
            if not await _until(frame, drawn):
                lines.append(f"scene {number + 1} draws nothing")
            elif await _has_motion(frame):
                first = await picture(frame)
                moves = await _until(frame, lambda now, first=first: differs(first, now))
                moving += moves
                lines += [] if moves else [f"scene {number + 1} has a motion and stands still"]
            report.add("scenes", name, lines)
    return moving


async def picture(frame: Locator) -> np.ndarray:
    """Pixels (height, width, 3) of a scene as it is on the screen."""
    data = await frame.screenshot()
    return np.asarray(Image.open(BytesIO(data)).convert("RGB")).astype(int)


def drawn(pixels: np.ndarray) -> bool:
    """Whether there is more than an empty stage."""
    spread = pixels.max(axis=2) - pixels.min(axis=2)
    return float((spread > COLOURED).mean()) >= LEAST_DRAWN


def differs(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether something has moved from one picture to another."""
    if first.shape != second.shape:
        return False
    return float((np.abs(first - second).max(axis=2) > COLOURED).mean()) > 1e-4


def has_motion(content: str) -> bool:
    """Whether the commands of a scene contain an animation."""
    for found in _COMMAND.finditer(content):
        try:
            if b"set_animation" in b64decode(found[1])[:200]:
                return True
        except Error:
            continue
    return False


async def _has_motion(frame: Locator) -> bool:
    inner = frame.content_frame
    texts = await inner.locator("html").evaluate_all("(all) => all.map((one) => one.outerHTML)")
    below = inner.locator("iframe")
    if await below.count():
        texts += [await below.first.get_attribute("srcdoc") or ""]
    return any(has_motion(text) for text in texts)


async def _until(frame: Locator, holds) -> bool:  # type: ignore[no-untyped-def]
    for _ in range(LOOKS):
        if holds(await picture(frame)):
            return True
        await frame.page.wait_for_timeout(APART)
    return False
