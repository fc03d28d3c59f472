"""Code for the kinematics of a chain: generated, compiled, and run for many configurations."""
