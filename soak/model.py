"""What must have arrived, by the rules alone."""

from __future__ import annotations

from collections import Counter
from typing import Any

from soak.messages import Question, Run

__all__ = ["Model"]


class Model:
    """Who has sent, received, asked and answered what.

    A life is a node from its start to its end. The rules:

    - Of each life, a subscriber gets messages in order and without a gap, from when it is
      connected.
    - What was sent by a life that ended well arrives at every subscriber that had been
      connected, and lives on.
    - A question is executed once at most, and one that was answered exactly once.
    """

    def __init__(self) -> None:
        self.problems: list[str] = []
        self.sent: dict[int, int] = {}
        """The last number of each life whose sending was completed."""
        self.slots: dict[int, int] = {}
        """The life in each slot, as it said last."""
        self._lives = 0
        self._alive: set[int] = set()
        self._ended_well: set[int] = set()
        self._runs: dict[tuple[int, str, int], Run] = {}
        self._questions = 0
        self._executed: Counter[int] = Counter()
        self._messages = self._answered = 0

    @property
    def text(self) -> str:
        return (
            f"{self._lives:,} lives, {self._messages:,} messages, {self._questions:,} calls of "
            f"which {self._answered:,} were answered"
        )

    # lives

    def begin(self) -> int:
        self._lives += 1
        self._alive.add(self._lives)
        return self._lives

    def ends(self, life: int) -> None:
        self._alive.discard(life)

    def ends_well(self, life: int) -> None:
        self._alive.discard(life)
        self._ended_well.add(life)

    def of_slot(self, number: int) -> int:
        return self.slots[number]

    # messages

    def got(self, subscriber: int, topic: str, publisher: int, number: int) -> None:
        self._messages += 1
        run = self._runs.setdefault((subscriber, topic, publisher), Run())
        run.got(number)
        if run.problems:
            self.problems += [
                f"{topic}, of life {publisher} to {subscriber}: {text}" for text in run.problems
            ]
            run.problems.clear()

    def heard(self, subscriber: int, topic: str) -> int:
        """How many messages came on a topic."""
        return sum(
            run.count
            for (who, what, _), run in self._runs.items()
            if (who, what) == (subscriber, topic)
        )

    # calls

    def question(self) -> int:
        self._questions += 1
        return self._questions

    def answer(self, request: Any) -> Any:
        """The handler of all services."""
        self._executed[request.number] += 1
        return Question.Response(life=request.life, number=request.number)

    def was_answered(self, question: int, answer: int) -> None:
        self._answered += 1
        if answer != question:
            self.problems.append(f"question {question} was answered with {answer}")
        if self._executed[question] != 1:
            self.problems.append(
                f"question {question} was answered, and executed {self._executed[question]} times"
            )

    # a calm

    def settle(self, alive: set[int]) -> None:
        """Check what only holds when nothing is under way, and forget what is over."""
        twice = [question for question, count in self._executed.items() if count > 1]
        if twice:
            self.problems.append(f"questions executed more than once: {twice[:5]}")
        for (subscriber, topic, publisher), run in self._runs.items():
            if subscriber in alive and publisher in self._ended_well:
                last = self.sent.get(publisher, -1)
                if run.last < last:
                    self.problems.append(
                        f"{topic}: life {publisher} ended well with message {last}, and life "
                        f"{subscriber} got no more than {run.last}"
                    )
        # Calls that were given up may still be executed, but not those of long ago.
        for question in [q for q in self._executed if q < self._questions - 10_000]:
            del self._executed[question]
        self._ended_well.clear()
        self._runs = {key: run for key, run in self._runs.items() if {key[0], key[2]} <= alive}
        self.sent = {life: number for life, number in self.sent.items() if life in alive}
