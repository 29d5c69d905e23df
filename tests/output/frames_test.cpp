// Frame files, read back.
#include "output/frames.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/read_text.hpp"
#include "mesh/obj.hpp"
#include "sample_model.hpp"
#include "support/scratch.hpp"

namespace pliant {
namespace {

using namespace test;

// Takes a value off the front of `bytes`.
template <class T>
T take(std::string_view& bytes) {
  REQUIRE(bytes.size() >= sizeof(T));
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

template <class T>
T next(std::istream& stream) {
  T value{};
  REQUIRE(stream >> value);
  return value;
}

glm::dvec3 next_vector(std::istream& stream) {
  glm::dvec3 vector;
  for (int axis = 0; axis < 3; ++axis) vector[axis] = next<double>(stream);
  return vector;
}

void check_close(const glm::dvec3& actual, const glm::dvec3& expected) {
  for (int axis = 0; axis < 3; ++axis) CHECK(actual[axis] == Approx(expected[axis]).epsilon(1e-11));
}

}  // namespace

TEST_CASE("an OBJ frame reads back as the positions and triangles it was written from") {
  const ScratchFolder folder;
  const Model model = two_bodies();
  const auto positions = some_vectors(1);
  write_obj(folder.path / "a.obj", model, positions);
  const TriangleMesh mesh = load_obj(folder.path / "a.obj").mesh;
  REQUIRE(mesh.positions.size() == positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) check_close(mesh.positions[i], positions[i]);
  CHECK(mesh.triangles == model.triangles);
}

TEST_CASE("an OBJ frame has an object a body") {
  const ScratchFolder folder;
  write_obj(folder.path / "a.obj", two_bodies(), some_vectors(1));
  std::istringstream lines(read_text(folder.path / "a.obj"));
  std::vector<std::string> objects;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("o ")) objects.push_back(line.substr(2));
  CHECK(objects == std::vector<std::string>{"left", "right_v_0_0_0"});
}

TEST_CASE("a PLY frame holds positions to the bit, velocities, colours and triangles") {
  const ScratchFolder folder;
  const Model model = two_bodies();
  const auto positions = some_vectors(2), velocities = some_vectors(3);
  write_ply(folder.path / "a.ply", model, positions, velocities);
  const std::string text = read_text(folder.path / "a.ply");
  const std::string end = "end_header\n";
  std::string_view bytes = std::string_view(text).substr(text.find(end) + end.size());
  CHECK(text.starts_with("ply\nformat binary_little_endian 1.0\n"));
  CHECK(text.find("element vertex 7\n") != std::string::npos);
  CHECK(text.find("element face 5\n") != std::string::npos);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) CHECK(take<double>(bytes) == positions[i][axis]);
    for (int axis = 0; axis < 3; ++axis) CHECK(take<float>(bytes) == static_cast<float>(velocities[i][axis]));
    const auto color = take<std::array<unsigned char, 3>>(bytes);
    // 188 is the sRGB byte of linear 0.5, 255 of white.
    CHECK(color == (i < 4 ? std::array<unsigned char, 3>{255, 188, 0} : std::array<unsigned char, 3>{255, 255, 255}));
    CHECK(take<std::int32_t>(bytes) == (i < 4 ? 0 : 1));
  }
  for (const auto& triangle : model.triangles) {
    CHECK(take<unsigned char>(bytes) == 3);
    CHECK(take<std::array<std::uint32_t, 3>>(bytes) == triangle);
  }
  CHECK(bytes.empty());
}

TEST_CASE("a VTK frame follows the legacy format section by section") {
  const ScratchFolder folder;
  const Model model = two_bodies();
  const auto positions = some_vectors(4), velocities = some_vectors(5);
  write_vtk(folder.path / "a.vtk", model, positions, velocities);
  std::istringstream in(read_text(folder.path / "a.vtk"));
  for (const char* expected : {"# vtk DataFile Version 3.0", "pliant", "ASCII", "DATASET POLYDATA", "POINTS 7 double"}) {
    std::string line;
    std::getline(in, line);
    CHECK(line == expected);
  }
  for (const glm::dvec3& position : positions) check_close(next_vector(in), position);
  for (const char* expected : {"POLYGONS", "5", "20"}) CHECK(next<std::string>(in) == expected);
  for (const auto& triangle : model.triangles) {
    CHECK(next<int>(in) == 3);
    for (const std::uint32_t corner : triangle) CHECK(next<std::uint32_t>(in) == corner);
  }
  for (const char* expected : {"POINT_DATA", "7", "VECTORS", "velocity", "double"}) CHECK(next<std::string>(in) == expected);
  for (const glm::dvec3& velocity : velocities) check_close(next_vector(in), velocity);
  for (const char* expected : {"SCALARS", "body", "int", "1", "LOOKUP_TABLE", "default"})
    CHECK(next<std::string>(in) == expected);
  for (int i = 0; i < 7; ++i) CHECK(next<int>(in) == (i < 4 ? 0 : 1));
  std::string rest;
  CHECK_FALSE(in >> rest);
}

TEST_CASE("frames are named so that their order is the alphabet's") {
  CHECK(frame_path("out", 7, FrameFormat::obj) == "out/frame_0007.obj");
  CHECK(frame_path("out", 12345, FrameFormat::png) == "out/frame_12345.png");
  CHECK(frame_path("out", 0, FrameFormat::ply).extension() == ".ply");
  CHECK(frame_path("out", 0, FrameFormat::vtk).extension() == ".vtk");
}

TEST_CASE("a frame that can't be written is an error with the path and a remedy") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "file") << "in the way";
  for (const auto& path : {folder.path / "file" / "a.obj", std::filesystem::path("/dev/full")}) {
    CAPTURE(path);
    try {
      write_obj(path, two_bodies(), some_vectors(1));
      FAIL("no error");
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find(path.string()) == 0);
      CHECK(std::string(error.what()).find("another place") != std::string::npos);
    }
  }
}

}  // namespace pliant
