"""Controller and plant in two processes: readings and torques go over UDP at 400 Hz. The plant's side, as a robot's drives must, has a watchdog:
50 ms without a command and it damps its joints. Here the controller is killed after two seconds."""

import multiprocessing
import socket
import struct
import time

import surefoot

DURATION, WATCHDOG, DAMPING = 2.0, 0.05, 4.0  # s, s, N·m·s/rad
READING, COMMAND = struct.Struct("<4d12d12d3d3d"), struct.Struct("<d12d")


def pack(reading: surefoot.SensorReading) -> bytes:
    return READING.pack(reading.time, reading.encoder_time, reading.torque_time, reading.imu_time, *reading.q, *reading.torque, *reading.gyro, *reading.accelerometer)


def unpack(data: bytes) -> surefoot.SensorReading:
    numbers, reading = READING.unpack(data), surefoot.SensorReading()
    reading.time, reading.encoder_time, reading.torque_time, reading.imu_time = numbers[:4]
    reading.q, reading.torque, reading.gyro, reading.accelerometer = numbers[4:16], numbers[16:28], numbers[28:31], numbers[31:]
    return reading


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
        _, other = link.recvfrom(16)
        link.settimeout(WATCHDOG)
        alive, late, begin = True, 0, time.monotonic()
        while plant.time < DURATION + 1.0:
            if plant.time >= DURATION:
                controller.kill()
            torque = [-DAMPING * speed for speed in plant.truth.qd]  # what drives do by themselves
            if alive:
                try:
                    link.sendto(pack(plant.read()), other)
                    torque = list(COMMAND.unpack(link.recv(COMMAND.size))[1:])
                except (TimeoutError, ConnectionError):
                    alive = False
                    print(f"{plant.time:.3f} s: no command for {1e3 * WATCHDOG:.0f} ms: the joints damp")
            plant.write(torque)
            late += time.monotonic() > begin + plant.time
            time.sleep(max(0.0, begin + plant.time - time.monotonic()))
    print(f"{late} ticks late; base at {plant.truth.p_SB[2]:.2f} m, joints at most {abs(plant.truth.qd).max():.2f} rad/s")
    assert not alive and plant.truth.p_SB[2] < 0.4
