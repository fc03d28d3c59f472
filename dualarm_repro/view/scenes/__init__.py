"""What a 3-D scene is made of: parts, arms, nearest pairs, the still picture and its HTML."""
