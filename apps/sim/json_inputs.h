// Inputs as lines of JSON, of a file or of a program that writes to a pipe:
//   {"body": "base_link", "stamp_ns": 20000000, "position": [x, y, z], "orientation": [x, y, z, w]}
//   {"disturbance": {"kind": "drop", "position_m": [x, y], "height_m": 0.2}, "stamp_ns": 20000000}
//   {"clock_ns": 20000000}
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

#include "apps/sim/inputs.h"

namespace swell::apps {

// What --rig-keys says of them.
inline constexpr std::string_view kJsonInputsText = R"(
--inputs: a line of JSON for each pose of a body with pose = "input", in metres in "map", for each
drop, footstep or rotor, by a scene's keys of [[disturbance]] without t_s, and for each time of the
clock, which comes after what is of its time
  {"body": "base_link", "stamp_ns": 0, "position": [x, y, z], "orientation": [x, y, z, w]}
  {"disturbance": {"kind": "drop", "position_m": [x, y], "height_m": 0.2}, "stamp_ns": 0}
  {"clock_ns": 0}
With --clock input all that is due up to a time is published, then the next time is waited for. A
body whose pose once came after its clock, as Gazebo's server has it, is waited for from then on:
until its pose comes or the clock goes on, at most 0.5 s. A clock that goes back, or ahead by over
10 s, starts again there. Between two poses a body goes along a line and turns the shorter way;
after the last one it stays.
)";

// Puts in what one line says; blank lines say nothing.
void take_json_line(std::string_view line, const InputOrigin& from, Inputs& inputs);

// Reads lines in a thread of its own until their end. A line has at most 64 KiB.
class JsonInputs : public InputSource {
 public:
  // A path, or "-". Throws texture::FileError where there is nothing to read; `inputs` has to
  // outlive it.
  JsonInputs(const std::string& path, Inputs& inputs);
  ~JsonInputs() override;
  JsonInputs(const JsonInputs&) = delete;
  JsonInputs& operator=(const JsonInputs&) = delete;

 private:
  void read();

  std::string name_;
  Inputs& inputs_;
  int file_ = -1;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

}  // namespace swell::apps
