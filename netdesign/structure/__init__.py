"""From the net's end forces to the forces in posts, guys and anchors."""
