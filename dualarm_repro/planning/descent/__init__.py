"""Descent in the field: steps, virtual point, why a run ends, proof of where it rests."""
