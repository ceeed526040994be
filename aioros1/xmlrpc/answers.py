"""The answers of master and nodes: ``[code, status, value]``, code 1 for success."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from aioros1.errors import ClosedError, MasterError, MasterUnreachable, PeerError, PeerUnreachable

if TYPE_CHECKING:
    from aioros1.xmlrpc.client import XmlRpcClient

__all__ = ["as_it_is", "call_triple"]

T = TypeVar("T")


def as_it_is(value: Any) -> Any:
    """What reads an answer that nothing is to be made of."""
    return value


async def call_triple(
    client: XmlRpcClient,
    uri: str,
    method: str,
    params: tuple[Any, ...],
    refused: type[MasterError] | type[PeerError],
    unreachable: type[MasterUnreachable] | type[PeerUnreachable],
    *,
    bare: bool = False,
    read: Callable[[Any], T] = as_it_is,
    timeout: float | None = None,
) -> T:
    """Call a method and return what ``read`` makes of the value of its answer.

    Raises ``refused`` for any code but 1, for a fault and for an answer that is not a
    triple or that ``read`` cannot read; ``unreachable`` when there is no answer. With
    ``bare`` an answer need not be a triple: roscpp answers ``getBusStats`` so.
    """
    from aioros1.wire.xmlrpc import XmlRpcError, XmlRpcFault

    try:
        answer = await client.call(uri, method, *params, timeout=timeout)
    except XmlRpcFault as fault:
        what = f"{method} at {uri}: {fault.text}"
        raise refused(fault.code, what, is_refusal=False) from fault
    except XmlRpcError as error:
        whose = "master" if refused is MasterError else "node"
        what = f"{error}; expected the answer of a ROS {whose}"
        raise refused(-1, what, is_refusal=False) from error
    except (OSError, TimeoutError) as error:
        raise unreachable(str(error)) from error
    except ClosedError as error:  # the client is closed, and with it its node
        raise ClosedError(f"{method} at {uri}: {error}") from error
    if isinstance(answer, list) and len(answer) == 3 and type(answer[0]) is int:
        code, status, value = answer
        if code != 1:
            raise refused(code, f"{method} at {uri}: {status}")
    elif bare:
        value = answer
    else:
        what = f"{method} at {uri}: expected [code, status, value], got {answer!r:.200}"
        raise refused(-1, what, is_refusal=False)
    try:
        return read(value)
    except (TypeError, ValueError, LookupError, AttributeError) as error:
        what = f"{method} at {uri}: cannot read {value!r:.200}: {error}"
        raise refused(-1, what, is_refusal=False) from error
