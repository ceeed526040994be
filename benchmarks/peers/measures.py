"""What the peers in Python measure, and how they tell it; ROS's Python runs this as well."""

import json
import resource

__all__ = ["cpu", "report", "report_times"]


def cpu():
    """Seconds of processor time that this process has used: user and system."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def report(**figures):
    """Write a line of JSON, with the most memory there was (bytes) where the system tells."""
    try:
        with open("/proc/self/status") as file:
            (peak,) = (line.split()[1] for line in file if line.startswith("VmHWM"))
    except (OSError, ValueError):
        # Not by getrusage: its maximum begins with what the starting process had.
        pass
    else:
        figures["rss"] = int(peak) * 1024
    print(json.dumps(figures), flush=True)


def report_times(times, seconds=None):
    """The times of ``count`` rounds, in seconds: how many, all together, p50 and p99 in µs."""
    times.sort()
    p50, p99 = times[len(times) // 2], times[len(times) * 99 // 100]
    seconds = sum(times) if seconds is None else seconds
    report(count=len(times), seconds=seconds, p50=p50 * 1e6, p99=p99 * 1e6)
