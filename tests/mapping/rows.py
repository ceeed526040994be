"""Which test, or which sentence, stands for each row of the pages for users of cROS and rcl.

``python tests/mapping/rows.py`` lists them. Tests are named after the functions of cROS and
rcl: a row is tested when its names are in the names, the parameters or the docstrings of
tests in this folder. A row for what does not exist here is covered by saying so.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

__all__ = ["PAGES", "SAME_AS", "MappingTest", "Row", "all_rows", "all_tests"]

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PAGES = [ROOT / "docs" / name for name in ("coming-from-cros.md", "coming-from-rcl.md")]

# What there is to say where nothing takes the place of something.
_NOTHING_HERE = re.compile(
    r"none\b|nothing\b|no (?:limit|event|counterpart)\b|gone\b|inside\b|as above|asyncio$|`await`$"
)

_CROS_NODES, _ROLES = "mapping/test_cros_nodes.py", "mapping/test_cros_roles.py"
_POLLING, _CLIENT = "mapping/test_cros_polling_and_sending.py", "mapping/test_rcl_client.py"

SAME_AS: dict[str, tuple[str, ...]] = {
    # the shape of a program
    "a callback with a context pointer": (f"{_ROLES}::test_SubscriberApiCallback_is_an_iteration",),
    "return 0 or 1 from a callback": (
        f"{_ROLES}::test_SubscriberApiCallback_that_fails_raises_where_it_is",
        f"{_ROLES}::test_ServiceProviderApiCallback_that_fails_says_why",
    ),
    "an index for each role": (
        f"{_ROLES}::test_CrosNodeStatusUsr_provider_idx_is_the_name_of_the_role",
    ),
    "a callback and a call id for each request to the master": (
        "mapping/test_cros_master_api.py::test_awaited_value_replaces_callback_and_result",
        "mapping/test_cros_master_api.py::test_callid_is_the_task",
    ),
    "an error code of four packed bytes": (
        "mapping/test_cros_errors.py::test_cRosErrCodePack_of_several_errors_is_an_ExceptionGroup",
    ),
    # nodes
    "the automatic `/rosout`, `~get_loggers`, `~set_logger_level`": (
        f"{_CROS_NODES}::test_cRosNodeCreate_has_rosout_and_logger_services_of_its_own",
        f"{_CROS_NODES}::test_cRosNodeCreate_without_rosout_and_logger_services",
    ),
    "`CN_MAX_XMLRPC_…`, `CN_MAX_TCPROS_…`, `CN_MAX_RPCROS_…_CONNECTIONS`": (
        f"{_CROS_NODES}::test_CN_MAX_TCPROS_SERVER_CONNECTIONS_is_a_limit_of_safety",
    ),
    "one thread, no dependency": (f"{_CROS_NODES}::test_single_thread",),
    "compatibility with MATLAB's toolbox": (
        f"{_CROS_NODES}::test_TCPROS_header_variants_of_MATLAB",
    ),
    # roles
    "`async for call in provider:`": (f"{_ROLES}::test_ServiceProviderApiCallback_is_not_needed",),
    "registration that happens some time later": (
        f"{_ROLES}::test_registration_is_done_when_a_role_is_handed_out",
    ),
    "`CROS_STATUS_PUBLISHER_UNREGISTERED`, `SUBSCRIBER_UNREGISTERED`, "
    "`SERVICE_PROVIDER_UNREGISTERED`, `PARAM_UNSUBSCRIBED`": (f"{_ROLES}::test_CrosNodeStatus",),
    "whether a role is registered": (
        f"{_ROLES}::test_registration_is_done_when_a_role_is_handed_out",
        f"{_ROLES}::test_registration_refused_is_raised_and_leaves_nothing",
    ),
    "`RoleRegistered`, `PeerConnected`, `PeerDisconnected`, `MasterLost`, `MasterRestarted`": (
        f"{_ROLES}::test_NodeStatusApiCallback_is_an_iteration_of_events",
        f"{_ROLES}::test_CrosNodeStatusUsr_xmlrpc_host_and_xmlrpc_port_are_the_peer",
    ),
    "the overflow flag": (f"{_POLLING}::test_cRosNodeReceiveTopicMsg_buff_overflow_is_dropped",),
    "registering and unregistering (internal in cROS)": (
        "mapping/test_cros_master_api.py::test_registerPublisher_and_unregisterPublisher",
        "mapping/test_cros_master_api.py::test_registerSubscriber_and_unregisterSubscriber",
        "mapping/test_cros_master_api.py::test_registerService_and_unregisterService",
    ),
    # programs
    "the rosmaster that comes with it": (
        "master/test_master.py::test_what_a_new_master_has",
        "cli/test_master.py::test_it_serves_until_a_signal",
    ),
    "`talker`, `listener`": (
        "test_examples.py::test_talker",
        "test_examples.py::test_listener",
        "test_examples.py::test_add_two_ints_server",
    ),
    "`parameters-test`": ("test_examples.py::test_parameters",),
    "`api-test`": ("test_examples.py::test_api_tour",),
    "`performance-test`": ("test_benchmarks.py::test_every_suite_measures_this_library",),
    "`ros-i-trajectory-test`": ("test_examples.py::test_joint_trajectory_monitor",),
    # rcl
    "`rcl_node_get_options`, `rcl_node_get_default_options`": (
        "mapping/test_rcl_node.py::test_rcl_node_get_options",
    ),
    "`rcl_publish_loaned_message`": (
        "mapping/test_rcl_publisher.py::test_rcl_publish_serialized_message",
    ),
    "whether the service is there": (
        f"{_CLIENT}::test_rcl_service_server_is_available",
        f"{_CLIENT}::test_rcl_service_server_is_available_once_it_is_provided",
    ),
    "`caller.node`, `caller.is_open`": (f"{_CLIENT}::test_rcl_client_t",),
}
"""The tests, below ``tests``, of rows that have no names, or whose names no test carries: by
the first cell that is not empty."""


@dataclass(frozen=True)
class MappingTest:
    place: str
    """``file::function``"""
    words: str
    """Everything that can name a function: its own name, its parameters, its docstring."""

    def carries(self, name: str, beginning: str = "") -> bool:
        """Whether the test has ``name`` after that ``beginning`` and, if it has one, whatever
        else. ``…`` stands for anything."""
        return _pattern(name, beginning).search(self.words) is not None


@cache
def _pattern(name: str, beginning: str) -> re.Pattern[str]:
    pattern = r"\w*".join(re.escape(part) for part in re.split("…", name.replace(".", "_")))
    if beginning:
        pattern = rf"{re.escape(beginning)}\w*{pattern}"
    return re.compile(rf"(?:\b|(?<=_)){pattern}(?:\b|(?=_))")


@dataclass(frozen=True)
class Row:
    place: str
    """``page:line``"""
    cells: tuple[str, ...]

    @property
    def key(self) -> str:
        return next(cell for cell in self.cells if cell)

    @property
    def names(self) -> list[str]:
        """The functions, constants and so on of the first cell."""
        spans = re.findall(r"`([^`]+)`", self.cells[0])
        return [re.split(r"[\s(,]", span.lstrip("&*"))[0] for span in spans]

    @property
    def sentence(self) -> str:
        """What is said in place of a test; empty when there is something to be tested."""
        here = self.cells[1]
        return " ".join(self.cells[1:]).strip() if _NOTHING_HERE.match(here) else ""

    def tests_of(self, name: str) -> list[str]:
        found = []
        if name != self.names[0]:  # `Free` after `xmlrpcParamInit` is `xmlrpcParamFree`
            found = carriers(name, self.names[0][:4])
        if not found and (name == self.names[0] or name[0].islower() or len(name) > 7):
            # But `String` alone may be anything.
            found = carriers(name)
        return found

    @property
    def tests(self) -> list[str]:
        found = {place: None for name in self.names for place in self.tests_of(name)}
        return list(dict.fromkeys([*SAME_AS.get(self.key, ()), *found]))

    @property
    def missing(self) -> list[str]:
        """The names that neither a test nor a sentence covers."""
        if self.sentence or self.key in SAME_AS:
            return []
        if not self.names:
            return [self.key]
        return [name for name in self.names if not self.tests_of(name)]


def rows_of(page: Path) -> Iterator[Row]:
    is_table = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if not line.startswith("|"):
            is_table = False
        elif re.fullmatch(r"[|\s:-]+", line):
            is_table = True  # what came before were the titles
        elif is_table:
            cells = re.split(r"(?<!\\)\|", line.strip().strip("|"))
            yield Row(f"{page.name}:{number}", tuple(cell.strip() for cell in cells))


def all_rows() -> list[Row]:
    return [row for page in PAGES for row in rows_of(page)]


@cache
def all_tests() -> tuple[MappingTest, ...]:
    return tuple(
        test
        for path in sorted(HERE.glob("test_*.py"))
        if path.name != "test_rows.py"  # which is about this file, with names for examples
        for test in _tests_of(path)
    )


@cache
def carriers(name: str, beginning: str = "") -> list[str]:
    """The places of the tests that carry ``name``."""
    return [test.place for test in all_tests() if test.carries(name, beginning)]


def _tests_of(path: Path) -> Iterator[MappingTest]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    # Parameters may stand in a table of the module.
    tables = {
        target.id: statement.value
        for statement in tree.body
        if isinstance(statement, ast.Assign)
        for target in statement.targets
        if isinstance(target, ast.Name)
    }
    for function in tree.body:
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        if function.name.startswith("test_"):
            words = [function.name, ast.get_docstring(function) or ""]
            for decorator in function.decorator_list:
                words += _strings(decorator, tables)
            yield MappingTest(f"mapping/{path.name}::{function.name}", "\n".join(words))


def _strings(node: ast.AST, tables: dict[str, ast.expr]) -> Iterator[str]:
    for part in ast.walk(node):
        if isinstance(part, ast.Constant) and isinstance(part.value, str):
            yield part.value
        elif isinstance(part, ast.Name) and part.id in tables:
            yield from _strings(tables[part.id], {})


def main() -> None:
    for row in all_rows():
        print(f"{row.place}: {row.key}")
        for place in row.tests:
            print(f"    {place}")
        if row.sentence:
            print(f"    {row.sentence}")
        for name in row.missing:
            print(f"    MISSING: {name}")


if __name__ == "__main__":
    main()
