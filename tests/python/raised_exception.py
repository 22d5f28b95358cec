# SPDX-License-Identifier: GPL-3.0-or-later
"""The exception that a call raises, for tests."""


def raised(kind, call, *arguments, **options):
    """The exception, which has to be of that very kind."""
    try:
        call(*arguments, **options)
    except BaseException as error:
        assert type(error) is kind, f"{type(error)}: {error}"
        return error
    raise AssertionError(f"{kind.__name__} was not raised")
