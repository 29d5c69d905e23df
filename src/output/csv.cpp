#include "output/csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "core/expect.hpp"

namespace pliant {
namespace {

// Writes a comma first, so that numbers can follow one another.
void append_number(std::string& line, double value) {
  if (!std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
  fmt::format_to(std::back_inserter(line), ",{:.17g}", value);
}

void append_vector(std::string& line, const glm::dvec3& vector) {
  for (int axis = 0; axis < 3; ++axis) append_number(line, vector[axis]);
}

OutputFile file_with(const std::filesystem::path& path, const std::string& text) {
  WholeFile beginning(path);
  beginning.write(text);
  beginning.close();
  return OutputFile(path, OutputFile::Begin::at_end);
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& path) : file_(path) {
  add("step,time,kinetic,elastic,gravitational,energy,px,py,pz,lx,ly,lz,contact_steps,reverted_vertices,outside_px,outside_py,"
      "outside_pz,contact_given,contact_taken,friction_work,work_of_scripts\n");
}

HistoryFile::HistoryFile(const std::filesystem::path& path, std::string so_far)
    : file_(file_with(path, so_far)), text_(std::move(so_far)) {}

void HistoryFile::add(const std::string& line) {
  file_.write(line);
  text_ += line;
}

void HistoryFile::append(const HistoryRow& row) {
  std::string line = fmt::format("{}", row.step);
  for (const double value :
       {row.time, row.kinetic, row.elastic, row.gravitational, row.kinetic + row.elastic + row.gravitational})
    append_number(line, value);
  append_vector(line, row.momentum);
  append_vector(line, row.angular_momentum);
  fmt::format_to(std::back_inserter(line), ",{},{}", row.contact_steps, row.reverted_vertices);
  append_vector(line, row.outside_impulse);
  for (const double value : {row.contact_given, row.contact_taken, row.friction_work, row.work_of_scripts})
    append_number(line, value);
  add(line += '\n');
  file_.flush();
}

void write_final_state(const std::filesystem::path& path, const Model& model, std::span<const glm::dvec3> positions,
                       std::span<const glm::dvec3> velocities) {
  PLIANT_EXPECT(positions.size() == model.vertex_count() && velocities.size() == model.vertex_count());
  WholeFile file(path);
  file.write("body,vertex,x,y,z,vx,vy,vz\n");
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    for (std::uint32_t vertex = 0; vertex < model.bodies[body].vertex_count; ++vertex) {
      std::string line = fmt::format("{},{}", body, vertex);
      append_vector(line, positions[model.bodies[body].first_vertex + vertex]);
      append_vector(line, velocities[model.bodies[body].first_vertex + vertex]);
      file.write(line += '\n');
    }
  }
  file.close();
}

}  // namespace pliant
