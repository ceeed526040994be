"""Prints a summary of every joint trajectory that is sent to a robot arm.

python examples/joint_trajectory_monitor.py [joint_path_command:=arm_controller/command]
"""

import aioros1
from aioros1.msg.trajectory_msgs import JointTrajectory


def summary(trajectory: JointTrajectory) -> str:
    frame, points = trajectory.header.frame_id or "no frame", trajectory.points
    if not points:
        return f"{frame}: empty, which means: stop"
    seconds = points[-1].time_from_start.to_sec()
    lines = [f"{frame}: {len(points)} points in {seconds:.2f} s"]
    for index, name in enumerate(trajectory.joint_names):
        path = [point.positions[index] for point in points if index < len(point.positions)]
        if path:
            lines.append(
                f"  {name}: {path[0]:+.3f} to {path[-1]:+.3f} rad, "
                f"within {min(path):+.3f} and {max(path):+.3f}"
            )
    return "\n".join(lines)


async def main(node: aioros1.Node) -> None:
    # A trajectory is sent once, so none may be lost, however long printing takes.
    async with node.subscribe("joint_path_command", JointTrajectory, overflow="block") as sub:
        print(f"waiting for trajectories on {sub.name}")
        async for trajectory in sub:
            print(summary(trajectory))


if __name__ == "__main__":
    aioros1.run(main)
