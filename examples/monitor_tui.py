"""Topics on a full screen: how often messages come, and the last of each.

python examples/monitor_tui.py TOPIC ...

Needs Textual: pip install textual
"""

import sys
from typing import Any, ClassVar

from textual.app import App, ComposeResult
from textual.widgets import DataTable, Footer, Header, Static

import aioros1


class Monitor(App[None]):
    """One row for each topic, and below the message of the row the cursor is on."""

    TITLE = "aioros1"
    BINDINGS: ClassVar = [("q", "quit", "Quit")]
    CSS = "DataTable { height: 1fr; } Static { height: 2fr; padding: 0 1; }"

    def __init__(self, topics: list[str], **node_options: Any) -> None:
        super().__init__()
        self.topics = topics
        self.options = {"anonymous": True, "on_error": "log"} | node_options
        self.last: dict[str, str] = {}

    def compose(self) -> ComposeResult:
        yield Header()
        yield DataTable(cursor_type="row")
        yield Static(id="message", markup=False)
        yield Footer()

    def on_mount(self) -> None:
        table = self.query_one(DataTable)
        for column in ("topic", "type", "messages", "Hz"):
            table.add_column(column, key=column)
        self.run_worker(self.watch())

    async def watch(self) -> None:
        """A worker of Textual is a task, and the node is at home in it."""
        async with aioros1.Node("monitor", **self.options) as node:
            self.sub_title = node.master_uri
            table = self.query_one(DataTable)
            for topic in self.topics:
                sub = await node.subscribe(topic)  # of any type; closed with the node
                table.add_row(sub.name, "", "0", "", key=sub.name)
                self.run_worker(self.follow(sub))
                node.timer(1, Rate(self, sub))
            await node.wait_closed()

    async def follow(self, sub: aioros1.Subscriber) -> None:
        async for message in sub:
            self.last[sub.name] = str(message)
            self.set(sub.name, "type", message._type)
            self.set(sub.name, "messages", str(sub.stats.messages))
            self.show()

    def set(self, topic: str, column: str, text: str) -> None:
        self.query_one(DataTable).update_cell(topic, column, text, update_width=True)

    def show(self) -> None:
        table = self.query_one(DataTable)
        topic = table.coordinate_to_cell_key(table.cursor_coordinate).row_key.value
        self.query_one("#message", Static).update(self.last.get(topic, "nothing yet"))

    def on_data_table_row_highlighted(self) -> None:
        self.show()


class Rate:
    """Called every second: how many messages came since."""

    def __init__(self, monitor: Monitor, sub: aioros1.Subscriber) -> None:
        self.monitor = monitor
        self.sub = sub
        self.before = 0

    def __call__(self, now: aioros1.Time) -> None:
        count = self.sub.stats.messages
        self.monitor.set(self.sub.name, "Hz", str(count - self.before))
        self.before = count


if __name__ == "__main__":
    if not sys.argv[1:]:
        raise SystemExit(__doc__)
    monitor = Monitor(sys.argv[1:])
    monitor.run()
    sys.exit(monitor.return_code)
