class StudyError(Exception):
    """A sentence for the person at the terminal."""
