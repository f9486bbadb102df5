"""What is wrong with an argument, in words. Stands before all functions of the package, compiled or not, so that each names the argument, what
was given and what would be valid."""

from __future__ import annotations

import ast
import contextlib
import difflib
import functools
import inspect
import operator
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from surefoot import _core
from surefoot._core import Error

MISMATCH = "incompatible function arguments"  # nanobind's
LARGEST = 2**31  # of a C++ int
F = TypeVar("F", bound=Callable[..., Any])


class ArgumentError(Error, TypeError):
    """An argument of a wrong type."""


class Unbound(Exception):
    """Arguments of other names, or of another number."""


def is_one(value: object, kinds: str) -> bool:
    """No array, and of these of NumPy's kinds of numbers; " ": what is not NumPy's."""
    return getattr(value, "shape", ()) == () and getattr(getattr(value, "dtype", None), "kind", " ") in kinds


def is_number(value: object) -> bool:
    return (hasattr(value, "__float__") or hasattr(value, "__index__")) and is_one(value, " fiub")


def is_whole(value: object) -> bool:
    return hasattr(value, "__index__") and is_one(value, " iu")


def is_truth(value: object) -> bool:
    return isinstance(value, bool) or is_one(value, "b")


def is_list(value: object) -> bool:
    is_scalar = getattr(value, "shape", None) == ()
    return isinstance(value, Iterable) and hasattr(value, "__len__") and not is_scalar and not isinstance(value, str | bytes | Mapping | set | frozenset)


def has_complex(given: Iterable[object]) -> bool:
    for each in given:  # in a loop's every tick: no generator
        if isinstance(each, np.ndarray) and each.dtype.kind == "c":
            return True
    return False


def has_bytes(given: Iterable[object]) -> bool:
    return any(isinstance(each, bytes) for each in given)


PLAIN: dict[str, tuple[Callable[[object], bool], str]] = {
    "float": (is_number, "a number"),
    "int": (is_whole, "a whole number"),
    "bool": (is_truth, "True or False"),
    "str": (lambda value: isinstance(value, str), "a text"),
    "None": (lambda value: value is None, "None"),
    "PathLike": (lambda value: isinstance(value, os.PathLike), "a path"),
    "Callable": (callable, "a function"),
    "Mapping": (lambda value: isinstance(value, Mapping), "a dict"),
    "dict": (lambda value: isinstance(value, dict), "a dict"),
    "list": (lambda value: isinstance(value, list), "a list"),
}


def same(value: Any) -> Any:
    return value


def number(value: Any) -> Any:
    """Python's own: neither JSON nor YAML has NumPy's."""
    if type(value) in (bool, int, float):
        return value
    return bool(value) if is_truth(value) else operator.index(value) if is_whole(value) else float(value)


NUMBERS = {"float", "int", "bool"}
LISTS = {"Sequence", "list"}
MANY = {"a number": "numbers", "a whole number": "whole numbers", "a text": "texts", "a dict": "dicts"}


class Kind:
    """What an annotation allows: `fits(value)`, and `text` for people. One that is not known allows everything. `plain(value)`: of one that fits,
    in Python's own numbers."""

    def __init__(self, node: ast.expr, names: Mapping[str, Any]) -> None:
        self.plain = same
        self.fits, self.text = self._read(node, names)

    def _read(self, node: ast.expr, names: Mapping[str, Any]) -> tuple[Callable[[object], bool], str]:
        if isinstance(node, ast.BinOp):
            left, right = Kind(node.left, names), Kind(node.right, names)
            self.plain = lambda value: (left if left.fits(value) else right).plain(value)
            text = left.text if left.text.endswith("a text") and right.text == "a path" else " or ".join(filter(None, [left.text, right.text]))
            return lambda value: left.fits(value) or right.fits(value), text
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return self._read(ast.parse(node.value, mode="eval").body, names)
        name = ast.unparse(node.value if isinstance(node, ast.Subscript) else node).rpartition(".")[2]
        if isinstance(node, ast.Subscript) and name in LISTS:
            one = Kind(node.slice, names)
            self.plain = lambda value: list(map(one.plain, value))
            return lambda value: is_list(value) and all(map(one.fits, value)), f"a list of {MANY.get(one.text, one.text or 'values')}"  # type: ignore[arg-type]
        if name in PLAIN:
            self.plain = number if name in NUMBERS else same
            return PLAIN[name]
        kind = names.get(name)
        if isinstance(kind, type):
            return lambda value: isinstance(value, kind), f"{'an' if name[0] in 'AEIOU' else 'a'} {name}"
        return lambda value: True, ""


class Form:
    """A function's parameters, with what each allows."""

    def __init__(self, signature: inspect.Signature, names: Mapping[str, Any]) -> None:
        self.signature = signature
        self.kinds = {name: Kind(ast.parse(parameter.annotation, mode="eval").body, names) for name, parameter in signature.parameters.items()
                      if isinstance(parameter.annotation, str)}  # fmt: skip

    def misfits(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Iterator[tuple[str, Any, str]]:
        try:
            bound = self.signature.bind(*args, **kwargs)
        except TypeError as error:
            raise Unbound(str(error)) from None
        for name, value in bound.arguments.items():
            if name not in self.kinds:
                continue
            kind = self.signature.parameters[name].kind
            each = [(name, value)]
            if kind is inspect.Parameter.VAR_POSITIONAL:
                each = [(name, one) for one in value]
            elif kind is inspect.Parameter.VAR_KEYWORD:
                each = list(value.items())
            yield from ((called, one, self.kinds[name].text) for called, one in each if not self.kinds[name].fits(one))

    def plain(self, args: tuple[Any, ...], kwargs: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """The same arguments, which fit."""
        bound = self.signature.bind(*args, **kwargs)
        for name, value in bound.arguments.items():
            if name not in self.kinds:
                continue
            kind, one = self.signature.parameters[name].kind, self.kinds[name].plain
            if kind is inspect.Parameter.VAR_POSITIONAL:
                bound.arguments[name] = tuple(map(one, value))
            elif kind is inspect.Parameter.VAR_KEYWORD:
                bound.arguments[name] = {each: one(given) for each, given in value.items()}
            else:
                bound.arguments[name] = one(value)
        return bound.args, bound.kwargs


def shown(value: object) -> str:
    text = " ".join(repr(value).split())
    return ("the text " if isinstance(value, str) else "") + (text if len(text) < 80 else text[:77] + "…")


def shape_of(value: Any) -> tuple[int, ...]:
    with contextlib.suppress(ValueError):  # its rows differ
        return tuple(np.shape(value))
    return ()


def complaint(misfits: list[tuple[str, Any, str]]) -> ArgumentError:
    """Of one argument, by what each of a function's forms would take."""
    name, value, _ = misfits[0]
    valid = " or ".join(dict.fromkeys(text for _, _, text in misfits))
    if "a list of numbers" in valid and is_list(value) and len(shape := shape_of(value)) > 1:
        return ArgumentError(f"{name} has the shape {shape}; {valid} would be valid, of one dimension")
    how = f": its place, robot.frames.index({value!r})" if name == "frame" and isinstance(value, str) else ""
    return ArgumentError(f"{name} is {shown(value)}; {valid} would be valid{how}")


def checked(given: F) -> F:
    """A function of Python, or all public ones of a class, whose arguments are checked by their annotations before each call, which then has
    Python's own numbers."""
    if isinstance(given, type):
        for name, member in list(vars(given).items()):
            if inspect.isfunction(member) and (name == "__init__" or name[0] != "_") and not hasattr(member, "__wrapped__"):
                setattr(given, name, checked(member))
        return given  # type: ignore[return-value]
    forms: list[Form] = []

    @functools.wraps(given)
    def call(*args: Any, **kwargs: Any) -> Any:
        if not forms:  # once all names are there
            forms.append(Form(inspect.signature(given), vars(_core) | given.__globals__ | vars(__import__("surefoot"))))
        try:
            for misfit in forms[0].misfits(args, kwargs):
                raise complaint([misfit])
            args, kwargs = forms[0].plain(args, kwargs)
        except Unbound as error:
            raise unbound(given.__qualname__.removesuffix(".__init__"), str(error), forms[0].signature, kwargs) from None
        return given(*args, **kwargs)

    return call  # type: ignore[return-value]


def check_takes(name: str, function: Callable[..., Any], names: str) -> None:
    """Of a function that the library calls with these arguments, "user, state"."""
    try:
        inspect.signature(function).bind(*names.split(", "))
    except TypeError as error:
        raise Error(f"{name}(): {error}; a function of {names} would be valid") from None
    except ValueError:  # a compiled one does not tell
        pass


def unbound(name: str, error: str, signature: inspect.Signature, kwargs: Mapping[str, Any]) -> ArgumentError:
    takes = [one for one in signature.parameters if one != "self"]
    field = next((each for each in kwargs if each not in takes and isinstance(getattr(getattr(_core, name, None), each, None), property)), None)
    if field is not None:
        return ArgumentError(f"{name}(): {field} is set behind it: made = {name}({', '.join(takes)}); made.{field} = …")
    near = next((found[0] for each in kwargs if each not in takes and (found := difflib.get_close_matches(each, takes, n=1))), None)
    hint = f"did you mean {near}? " if near else ""
    return ArgumentError(f"{name}(): {error}; {hint}its arguments are {', '.join(takes)}")


def signature_of(text: str, defaults: tuple[Any, ...] | None) -> inspect.Signature:
    """Of nanobind's "def push(self, force: …, duration: float = \\0) -> None"."""
    code = re.sub(r"\\=?\d+", "...", text).replace("def (", "def _(")
    function = ast.parse(f"{code}: ...").body[0]
    assert isinstance(function, ast.FunctionDef)
    listed = function.args
    values = iter(defaults or ())
    made = []
    groups: list[tuple[list[ast.arg], Any, Sequence[ast.expr | None]]] = [
        (listed.posonlyargs + listed.args, inspect.Parameter.POSITIONAL_OR_KEYWORD, listed.defaults),
        (listed.kwonlyargs, inspect.Parameter.KEYWORD_ONLY, listed.kw_defaults),
    ]
    for group, kind, given in groups:
        missing = len(group) - len(given)
        for place, argument in enumerate(group):
            node = given[place - missing] if place >= missing else None
            default: Any = inspect.Parameter.empty
            if node is not None:
                written = ast.unparse(node)
                default = next(values, ...) if written == "..." else float("inf") if written == "float('inf')" else ast.literal_eval(node)
            annotation = inspect.Parameter.empty if argument.annotation is None else ast.unparse(argument.annotation)
            made.append(inspect.Parameter(argument.arg, kind, default=default, annotation=annotation))
    return inspect.Signature(made, return_annotation=ast.unparse(function.returns) if function.returns else inspect.Signature.empty)


def is_mismatch(error: TypeError) -> bool:
    """Of the call itself, and none within it, as of a user's function."""
    inside = error.__traceback__ and error.__traceback__.tb_next
    return MISMATCH in str(error) and inside is None


def told(function: Any, name: str, argument: str = "") -> Callable[..., Any]:
    """A compiled function whose complaint about its arguments names one. argument: what its only one is called."""
    signatures = function.__nb_signature__
    takes = " ".join(each[0] for each in signatures)
    is_odd = has_complex if "Sequence[float]" in takes else has_bytes if "os.PathLike" in takes else None
    forms: list[Form] = []

    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            # Without a word the imaginary part of an array would be left out, and bytes taken for a path.
            if not (is_odd and (is_odd(args) or is_odd(kwargs.values()))):
                return function(*args, **kwargs)
        except TypeError as error:
            if not is_mismatch(error):
                raise
        if not forms:
            forms.extend(Form(signature_of(each[0], each[2]), vars(_core)) for each in signatures)
        for form in forms:
            try:
                if not [*form.misfits(args, kwargs)]:
                    plain = form.plain(args, kwargs)
                    return function(*plain[0], **plain[1])
            except Unbound:
                continue
            except TypeError as error:
                if not is_mismatch(error):
                    raise
        raise explained(forms, name, argument, args, kwargs) from None

    call.__wrapped__, call.__doc__ = function, function.__doc__  # type: ignore[attr-defined]
    call.__name__, call.__qualname__, call.__module__ = name.rpartition(".")[2], name, "surefoot"
    if len(signatures) == 1:
        call.__signature__ = signature_of(signatures[0][0], signatures[0][2])  # type: ignore[attr-defined]
        call.__doc__ = signatures[0][1]
    return call


def explained(forms: list[Form], name: str, argument: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> ArgumentError:
    found, unfit = [], ""
    for form in forms:
        try:
            found.append([(argument or each, value, text) for each, value, text in form.misfits(args, kwargs)])
        except Unbound as error:
            unfit = unfit or str(error)
    if not found:
        return unbound(name, unfit, forms[0].signature, kwargs)
    fewest = min(found, key=len)
    if not fewest:
        with contextlib.suppress(TypeError):
            for each, value in forms[0].signature.bind(*args, **kwargs).arguments.items():
                if is_whole(value) and not -LARGEST <= operator.index(value) < LARGEST:
                    return ArgumentError(f"{argument or each} is {value}; a whole number from {-LARGEST} to {LARGEST - 1} would be valid")
        return ArgumentError(f"{name}(): these arguments do not go together; help({name}) says which would be valid")
    return complaint([each[0] for each in found if len(each) == len(fewest)])


def refuse_other_names(kind: type) -> None:
    """Of a class whose fields are set: what is set under a name that it has not, is told with the nearest."""

    def assign(self: object, name: str, value: object) -> None:
        try:
            object.__setattr__(self, name, value)
        except AttributeError:
            if hasattr(kind, name):
                raise AttributeError(f"{name} of a {kind.__name__} can't be replaced; what is in it can be written, if anything") from None
            names = [each for each, member in vars(kind).items() if isinstance(member, property) and member.fset is not None]
            near = difflib.get_close_matches(name, names, n=1)
            hint = f"did you mean {near[0]}? " if near else ""
            raise AttributeError(f"a {kind.__name__} has no {name}; {hint}it has {', '.join(names)}") from None

    setattr(kind, "__setattr__", assign)


def tell() -> None:
    """Lets all functions of the compiled module name what is wrong."""
    for name, thing in list(vars(_core).items()):
        if type(thing).__name__ == "nb_func":
            setattr(_core, name, told(thing, name))
        elif isinstance(thing, type) and thing.__module__ == _core.__name__:
            if any(isinstance(inner, property) and inner.fset is not None for inner in vars(thing).values()):
                refuse_other_names(thing)
            for member, inner in list(vars(thing).items()):
                if isinstance(inner, property) and inner.fset is not None:
                    setattr(thing, member, property(inner.fget, told(inner.fset, f"{name}.{member}", member), doc=inner.__doc__))
                elif type(inner).__name__ == "nb_method" and (member in ("__init__", "__getitem__") or member[0] != "_"):
                    shown_name = name.removesuffix("Base")
                    setattr(thing, member, told(inner, f"{shown_name}.{member}" if member != "__init__" else shown_name))
