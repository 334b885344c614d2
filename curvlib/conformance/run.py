"""All checks on one estimator."""

import inspect
import warnings
from collections import namedtuple

from curvlib.catalogue import estimators
from curvlib.errors import InputError, MeshWarning

from .checks import CHECKS
from .subject import Broken, NotApplicable, Subject

Verdict = namedtuple("Verdict", "check verdict words line")
Verdict.__doc__ = """The outcome of a check.

Attributes
----------
check : str
verdict : str
    "pass", "fail" or "not applicable".
words : str
    What is checked, or why it fails or says nothing.
line : int or None
    Of the estimator's function in its file, where it fails; an error inside it names its own line
    in `words`.
"""


def verdicts(estimator: str):
    """Yield the Verdict of each check, as it is done, on an estimator: a name, or a path.

    Raises InputError where the file cannot be loaded or is no estimator's.
    """
    subject = Subject(estimator)
    function = getattr(subject.signature.function, "py_func", subject.signature.function)
    line = inspect.getsourcelines(function)[1]
    for check in CHECKS:
        name = check.__name__.replace("_", " ")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", MeshWarning)
                check(subject)
        except (Broken, InputError) as error:
            yield Verdict(name, "fail", str(error), line)
        except NotApplicable as error:
            yield Verdict(name, "not applicable", str(error), None)
        except Exception as error:
            told = estimators.told(error)
            if told is None:
                raise
            yield Verdict(name, "fail", str(told), line)
        else:
            yield Verdict(name, "pass", " ".join((check.__doc__ or "").split()), None)
