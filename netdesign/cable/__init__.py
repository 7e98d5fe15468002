"""The net as an elastic cable between its foot and its head."""
