class StudyError(Exception):
    """A sentence for the person at the terminal, without characters that a terminal obeys."""

    def __str__(self):
        return "".join(letter if letter.isprintable() or letter == "\n" else "\N{REPLACEMENT CHARACTER}" for letter in super().__str__())
