"""Names of outputs, for those who plan files and for those who write them."""

STUDY_FILE = "study.json"
PROFILES_FILE = "profiles.html"  # the page that compares several profiles
WHAT_IF_MARK = "what-if-"  # before the name of every file of a what-if
