"""Paths become motions: time within limits of speed and acceleration, and files of them."""
