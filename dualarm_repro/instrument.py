"""Twins of compiled functions in plain Python, which count operations and note returns.

The machine code of a kernel can be neither traced nor counted. A twin is made from the source of
the same function, and of every kernel that it calls, so that what is counted is what is run.
"""

from __future__ import annotations

import ast
import inspect
import operator
import textwrap
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

_OPERATORS = {
    ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "truediv", ast.Pow: "pow",
}  # fmt: skip
_FUNCTIONS = ("exp", "expm1", "log", "log1p", "sqrt", "hypot", "tanh", "sinh", "sin", "cos")


class Cost(NamedTuple):
    """Operations on real numbers, and roots and elementary functions."""

    operations: int
    functions: int

    def total(self, function_cost: float = 1.0) -> float:
        """Operations, a function counted as so many."""
        return self.operations + function_cost * self.functions


class Instrument:
    """Counts arithmetic on real numbers and notes the order in which functions return.

    Attributes
    ----------
    operations : int
        Additions, subtractions, multiplications, divisions and powers of real numbers so far;
        indices are not counted.
    functions : int
        Roots and elementary functions.
    returned : list of str
        Names of the functions in the order of their returns.
    """

    def __init__(self) -> None:
        self.operations = self.functions = 0
        self.returned: list[str] = []
        self._twins: dict[Callable[..., Any], Callable[..., Any]] = {}

    def twin(self, kernel: Any) -> Callable[..., Any]:
        """The function behind a kernel, instrumented, and all kernels it calls as well."""
        function = kernel.py_func
        if function not in self._twins:
            tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
            (definition,) = tree.body
            definition.decorator_list = []  # type: ignore[attr-defined]
            tree = ast.fix_missing_locations(_Counted().visit(tree))
            names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
            scope = dict(function.__globals__) | {"_counted": self._count}
            exec(compile(tree, inspect.getfile(function), "exec"), scope)
            self._twins[function] = self._noted(scope[function.__name__], function.__name__)
            for name in names:
                if hasattr(function.__globals__.get(name), "py_func"):
                    scope[name] = self.twin(function.__globals__[name])
        return self._twins[function]

    def cost(self, kernel: Any, *arguments: Any) -> Cost:
        """What one call takes."""
        operations, functions = self.operations, self.functions
        self.twin(kernel)(*arguments)
        return Cost(self.operations - operations, self.functions - functions)

    def _noted(self, function: Callable[..., Any], name: str) -> Callable[..., Any]:
        def noted(*arguments: Any) -> Any:
            value = function(*arguments)
            self.returned.append(name)
            return value

        return noted

    def _count(self, name: str, *parts: Any) -> Any:
        if name == "sum":
            self.operations += max(np.size(parts[0]) - 1, 0)
            return parts[0].sum()
        elementary = name in _FUNCTIONS
        value = getattr(np if elementary else operator, name)(*parts)
        done = 0
        if isinstance(value, float | np.floating):
            done = 1
        elif isinstance(value, np.ndarray) and value.dtype.kind == "f":
            done = value.size
        self.functions += done if elementary else 0
        self.operations += 0 if elementary else done
        return value


class _Counted(ast.NodeTransformer):
    """Arithmetic becomes a call that counts it; in place stays in place."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        name = _OPERATORS.get(type(node.op))
        return _call(name, node.left, node.right) if name else node

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
        self.generic_visit(node)
        name = _OPERATORS.get(type(node.op))
        if name is None:
            return node
        read = ast.parse(ast.unparse(node.target), mode="eval").body
        return ast.Assign([node.target], _call(f"i{name}", read, node.value))

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        called = node.func
        if isinstance(called, ast.Attribute):
            if called.attr == "sum" and not node.args:
                return _call("sum", called.value)
            if ast.unparse(called.value) == "np" and called.attr in _FUNCTIONS:
                return _call(called.attr, *node.args)
        return node


def _call(name: str, *parts: ast.expr) -> ast.Call:
    return ast.Call(ast.Name("_counted", ast.Load()), [ast.Constant(name), *parts], [])
