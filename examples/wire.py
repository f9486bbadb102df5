"""What 08_two_processes.py sends, and how."""

import socket
import struct

import surefoot

READING, COMMAND = struct.Struct("<4d12d12d3d3d"), struct.Struct("<d12d")


def pack(reading: surefoot.SensorReading) -> bytes:
    return READING.pack(reading.time, reading.encoder_time, reading.torque_time, reading.imu_time, *reading.q, *reading.torque, *reading.gyro, *reading.accelerometer)


def unpack(data: bytes) -> surefoot.SensorReading:
    n, reading = READING.unpack(data), surefoot.SensorReading()
    reading.time, reading.encoder_time, reading.torque_time, reading.imu_time = n[:4]
    reading.q, reading.torque, reading.gyro, reading.accelerometer = n[4:16], n[16:28], n[28:31], n[31:]
    return reading


def answer(link: socket.socket, reading: surefoot.SensorReading) -> list[float] | None:
    """The torques for a reading; None where they don't come before the socket's time is over."""
    try:
        link.send(pack(reading))
        while (numbers := COMMAND.unpack(link.recv(COMMAND.size)))[0] != reading.time:
            pass
        return list(numbers[1:])
    except (TimeoutError, ConnectionError):
        return None
