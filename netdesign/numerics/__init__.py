"""Methods that know nothing of snow or nets."""
