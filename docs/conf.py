"""How the documentation is built: ``sphinx-build -n -W docs docs/_build``."""

from __future__ import annotations

import builtins
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

import aioros1

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


def setup(app: Any) -> None:
    app.connect("missing-reference", _find_by_end)
