"""Controller and plant in two processes: readings and torques go over UDP at 400 Hz. The plant's side, as a robot's drives must, has a watchdog:
50 ms without a command and it damps its joints. Here the controller is killed after two seconds."""

import multiprocessing
import socket
import time

import surefoot
from wire import COMMAND, READING, answer, unpack

DURATION, WATCHDOG, DAMPING = 2.0, 0.05, 4.0  # s, s, N·m·s/rad


def control(port: int) -> None:
    controller = surefoot.Controller("anymal_b")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
        link.connect(("127.0.0.1", port))
        link.send(b"ready")
        while True:
            reading = unpack(link.recv(READING.size))
            link.send(COMMAND.pack(reading.time, *controller.step(reading, surefoot.UserCommand()).torque))


if __name__ == "__main__":
    plant = surefoot.Plant(surefoot.load_scenario("walk_flat"))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
        link.bind(("127.0.0.1", 0))
        controller = multiprocessing.get_context("spawn").Process(target=control, args=(link.getsockname()[1],), daemon=True)
        controller.start()
        link.connect(link.recvfrom(16)[1])  # it is ready
        link.settimeout(WATCHDOG)
        driven: list[list[float] | None] = []
        late, begin = 0, time.monotonic()
        while plant.time < DURATION + 1.0:
            if plant.time >= DURATION:
                controller.kill()
            driven.append(torque := answer(link, plant.read()))
            plant.write(torque or [-DAMPING * speed for speed in plant.truth.qd])  # what drives do by themselves
            late += time.monotonic() > begin + plant.time
            time.sleep(max(0.0, begin + plant.time - time.monotonic()))
    ticks = len(driven) - driven.count(None)
    print(f"driven for {ticks / 400:.2f} s, {late} ticks late; base at {plant.truth.p_SB[2]:.2f} m, joints at most {abs(plant.truth.qd).max():.2f} rad/s")
    assert ticks > 400 * DURATION / 2 and not any(driven[-300:]) and plant.truth.p_SB[2] < 0.4
