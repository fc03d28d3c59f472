"""Two tasks of two IRB 120 face to face: one whose straight line is free, one whose is not."""

_PAIR = """\
arms:
  left: {{robot: irb120, xyz: [-0.4, 0, 0], start: {left[0]}, goal: {left[1]}}}
  right: {{robot: irb120, xyz: [0.4, 0, 0], rpy: [0, 0, pi], start: {right[0]}, goal: {right[1]}}}
"""


def _bent(turn):
    return f'["{turn} deg", "60 deg", -0.5, 0, 0, 0]'


def _upright(turn):
    return f'["{turn} deg", 0, 0, 0, 0, 0]'


#: Both arms turn away from each other.
FREE = _PAIR.format(left=(_upright(60), _upright(100)), right=(_upright(60), _upright(100)))
#: Both arms turn through the middle at the same time.
BLOCKED = _PAIR.format(left=(_bent(60), _bent(-60)), right=(_bent(-60), _bent(60)))


def written(folder, text, name="pair.yaml"):
    """The path of a scene file with this text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path
