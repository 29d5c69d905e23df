// Writes the numbers of a run as CSV, with 17 digits, which hold every bit of a double. A number that is not finite is `nan`.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "model/model.hpp"
#include "output/file.hpp"

namespace pliant {

/// One row of history.csv.
struct HistoryRow {
  std::uint64_t step = 0;
  double time = 0;                      // [s]
  double kinetic = 0;                   // [J]
  double elastic = 0;                   // [J]
  double gravitational = 0;             // [J], zero at the world's origin
  glm::dvec3 momentum{0.0};             // [kg m/s]
  glm::dvec3 angular_momentum{0.0};     // about the world's origin [kg m^2/s]
  std::uint64_t contact_steps = 0;      // since the start
  std::uint64_t reverted_vertices = 0;  // since the start
  glm::dvec3 outside_impulse{0.0};      // that rigid bodies and grounds gave since the start [Ns]
  double contact_given = 0;             // energy that contacts gave since the start [J]
  double contact_taken = 0;             // energy that contacts took since the start [J]
  double friction_work = 0;             // what friction took of both [J]
  double work_of_scripts = 0;           // what scripted bodies gave by moving since the start [J]
};

/// history.csv, which can be read while it grows. All functions but text() throw Error (command_line) if it can't be written.
class HistoryFile {
 public:
  explicit HistoryFile(const std::filesystem::path& path);
  /// Goes on behind `so_far`, an earlier text(). A file at `path` is replaced as a whole.
  HistoryFile(const std::filesystem::path& path, std::string so_far);
  void append(const HistoryRow& row);
  /// Returns the header and the rows so far.
  [[nodiscard]] const std::string& text() const { return text_; }
  void close() { file_.close(); }

 private:
  void add(const std::string& line);
  OutputFile file_;
  std::string text_;
};

/// Writes final_state.csv with one row a vertex: its body, its number in the body, its position [m] and velocity [m/s] in the
/// world. The file appears as a whole. Throws Error (command_line) if it can't be written.
void write_final_state(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
                       std::span<const glm::dvec3> velocities);

}  // namespace pliant
