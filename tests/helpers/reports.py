"""A progress callback that keeps what it is told."""


class Reports(list):
    """The sentences of all reports, in order."""

    def __call__(self, share, sentence):
        assert 0.0 <= share <= 1.0
        self.append(sentence)
