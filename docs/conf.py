"""How the documentation is built: ``sphinx-build -n -W docs docs/_build``."""

from __future__ import annotations

import builtins
import re
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

from sphinx.pycode import ModuleAnalyzer

import aioros1
import aioros1.testing
from aioros1._public import HOMES

project = "aioros1"
author = "The aioros1 developers"
copyright = "2026, the aioros1 developers"  # noqa: A001
release = version = aioros1.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc"]
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = "aioros1"

myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}
# Signatures say it all; names that exist only while types are checked say nothing here.
autodoc_typehints = "none"
autodoc_preserve_defaults = True

# The documentation is built without a network, so names of the standard library are not
# looked up. Everything else has to be found.
_STANDARD = "|".join(sorted(sys.stdlib_module_names))
nitpick_ignore_regex = [
    (r"py:.*", rf"({_STANDARD})(\..*)?"),
    (r"py:.*", "|".join(name for name in dir(builtins) if not name.startswith("_"))),
]


def _find_by_end(app: Any, env: Any, node: Any, content: Any) -> Any:
    """Docstrings say ``Node`` where a module knows that name only while types are checked."""
    if node.get("refdomain") != "py":
        return None
    domain = env.domains["py"]
    end = "." + node["reftarget"].lstrip(".")
    found = [
        name for name, entry in domain.objects.items() if name.endswith(end) and not entry.aliased
    ]
    if len(found) != 1:
        return None
    return domain.resolve_xref(
        env, node["refdoc"], app.builder, node["reftype"], found[0], node, content
    )


def _read_sources(app: Any) -> None:
    """Descriptions of attributes are read from the source of the module that a class shows.
    That is the one it is imported from; here they are moved there from where it is written."""
    for path, module in list(sys.modules.items()):
        if path.partition(".")[0] == "aioros1":
            for name in getattr(module, "__all__", ()):
                getattr(module, name)  # which imports it, where that waits for its use
    for path, home in HOMES.items():
        shown, _, name = path.rpartition(".")
        target, source = (ModuleAnalyzer.for_module(module) for module in (shown, home))
        target.analyze()
        source.analyze()
        own = re.compile(rf"{name}(\..+)?")
        for (scope, attribute), text in source.attr_docs.items():
            if own.fullmatch(scope):
                target.attr_docs[scope, attribute] = text
        for tag, order in source.tagorder.items():
            if own.fullmatch(tag):
                target.tagorder[tag] = order
        for tag, signatures in source.overloads.items():
            if own.fullmatch(tag):
                target.overloads[tag] = signatures


# The library makes these and hands them out: how is nothing to rely on.
_HANDED_OUT = {
    "EventStream", "Graph", "GraphChanges", "MasterProxy", "Merge", "NodeLog", "NodeProxy",
    "Opening", "ParamSubscriber", "PendingCall", "Publisher", "Rate", "Role", "ServiceCall",
    "ServiceCaller", "ServiceProvider", "SparseLog", "Subscriber", "Timer",
    "testing.FlakyConnection", "testing.MakeFlakyProxy", "testing.MakeNode",
}  # fmt: skip


def _hide_constructor(
    app: Any, what: str, name: str, obj: Any, options: Any, signature: str, returns: str
) -> tuple[str, str | None] | None:
    return ("", None) if name.removeprefix("aioros1.") in _HANDED_OUT else None


def setup(app: Any) -> None:
    app.connect("autodoc-process-signature", _hide_constructor)
    app.connect("builder-inited", _read_sources)
    app.connect("missing-reference", _find_by_end)
