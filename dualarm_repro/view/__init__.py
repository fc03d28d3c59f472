"""Figures in one house style, item cards for the book, and static 3-D scenes."""
