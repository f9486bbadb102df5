#pragma once

// What 08_two_processes.cpp sends, and how.

#include "surefoot/robot.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>

using Sensors = Eigen::Matrix<double, 34, 1>;  // four times, q, torque, gyro, accelerometer
using Command = Eigen::Matrix<double, 13, 1>;  // time of the reading, torques

inline Sensors packed(const surefoot::SensorReading& r) {
  Sensors packet;
  packet << r.time, r.encoder_time, r.torque_time, r.imu_time, r.q, r.torque, r.gyro,
      r.accelerometer;
  return packet;
}

inline surefoot::SensorReading unpacked(const Sensors& packet) {
  surefoot::SensorReading r;
  r.time = packet[0], r.encoder_time = packet[1], r.torque_time = packet[2], r.imu_time = packet[3];
  r.q = packet.segment<12>(4), r.torque = packet.segment<12>(16);
  r.gyro = packet.segment<3>(28), r.accelerometer = packet.tail<3>();
  return r;
}

/// Two UDP sockets of this machine, each connected to the other. On two machines each knows the
/// other's address. A receive gives up after 50 ms.
inline std::array<int, 2> udp_pair() {
  std::array<int, 2> ends{};
  std::array<sockaddr_in, 2> at{};
  socklen_t size = sizeof(sockaddr_in);
  for (std::size_t k = 0; k < 2; ++k) {
    ends[k] = socket(AF_INET, SOCK_DGRAM, 0);
    at[k].sin_family = AF_INET, at[k].sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    bind(ends[k], reinterpret_cast<sockaddr*>(&at[k]), size);
    getsockname(ends[k], reinterpret_cast<sockaddr*>(&at[k]), &size);
    const timeval patience{.tv_sec = 0, .tv_usec = 50'000};
    setsockopt(ends[k], SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  for (std::size_t k = 0; k < 2; ++k)
    connect(ends[k], reinterpret_cast<sockaddr*>(&at[1 - k]), size);
  return ends;
}

/// Sends a reading. False where its command does not come in time.
inline bool exchange(int udp, const surefoot::SensorReading& reading, Command& command) {
  const Sensors sent = packed(reading);
  send(udp, sent.data(), sizeof sent, 0);
  for (command[0] = -1.0; command[0] != reading.time;)
    if (recv(udp, command.data(), sizeof command, 0) <= 0) return false;  // 50 ms have passed
  return true;
}
