#include "bench/contact/report.hpp"

#include <fmt/format.h>

#include "bench/common/report_parts.hpp"

namespace pliant::bench {
namespace {

std::string line(const ApartRow& row) {
  return fmt::format(
      "{:<22} {:<6} {:>4} {:>8} {:>7} {:>6} {:>6} {:>6} {:>8} {:>7} {:>5} {:>8} {:>6} {:>6} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e} "
      "{:>9.1e}\n",
      row.bodies, name_of(row.device), row.precision, row.vertices, row.edges_a_step, row.steps, row.parts, row.parts_in_all,
      row.contact_parts, row.cut_vertices, row.held_parts, row.touching, row.inside,
      row.broke_down ? "broke"
      : row.parted   ? "yes"
                     : "no",
      row.momentum_change, row.momentum_change_alone, row.angular_momentum_change, row.most_energy, row.last_energy);
}

std::string line(const ImpactRow& row) {
  const auto error = [](const std::optional<double>& known) { return known ? fmt::format("{:.2e}", *known) : "-"; };
  return fmt::format("{:<9} {:<8} {:>8g} {:>4} {:>11.5f} {:>8.4f} {:>9.1e} {:>9} {:>9} {:>9}\n", row.response, row.integrator,
                     row.stiffness, row.elasticity, row.omega_step, row.kept, row.most_energy, error(row.position_error),
                     error(row.momentum_error), error(row.spin_error));
}

std::string line(const RestRow& row) {
  return fmt::format("{:<22} {:<6} {:>4} {:>6} {:>8} {:>6} {:>9.1e} {:>9.1e}\n", row.bodies, name_of(row.device), row.precision,
                     row.steps, row.contacts, row.cut_vertices, row.most_a_step, row.drift);
}

std::string line(const CostRow& row) {
  return fmt::format("{:<6} {:>4} {:>8} {:>7g} {:>8} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n", name_of(row.device), row.precision,
                     row.vertices, row.edges_a_step, row.contacts, row.microseconds, row.microseconds_apart,
                     row.microseconds - row.microseconds_apart, row.microseconds_without);
}

std::string line(const SelfCostRow& row) {
  return fmt::format("{:<12} {:<6} {:>4} {:>8} {:>7} {:>6} {:>9.1f} {:>9.1f} {:>6.2f}\n", row.mesh, name_of(row.device),
                     row.precision, row.vertices, row.rests ? "rests" : "flies", row.cut_vertices, row.microseconds_without,
                     row.microseconds, row.microseconds / row.microseconds_without);
}

template <class Row>
std::string lines_of(const ContactResult& result, const std::string& header) {
  std::string lines;
  for (const ContactRow& row : result.rows)
    if (const auto* found = std::get_if<Row>(&row)) lines += line(*found);
  return lines.empty() ? lines : header + lines + '\n';
}

Json row_json(const ApartRow& row) {
  return {{"kind", "apart"},
          {"bodies", row.bodies},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"mass_ratio", row.mass_ratio},
          {"radius_ratio", row.radius_ratio},
          {"far_away", row.far_away},
          {"edges_a_step", row.edges_a_step},
          {"omega_step", row.omega_step},
          {"steps", row.steps},
          {"parts", row.parts},
          {"parts_in_all", row.parts_in_all},
          {"contact_parts", row.contact_parts},
          {"cut_vertices", row.cut_vertices},
          {"held_parts", row.held_parts},
          {"touching", row.touching},
          {"inside", row.inside},
          {"parted", row.parted},
          {"broke_down", row.broke_down},
          {"momentum_change", row.momentum_change},
          {"momentum_change_alone", row.momentum_change_alone},
          {"angular_momentum_change", row.angular_momentum_change},
          {"most_energy", row.most_energy},
          {"last_energy", row.last_energy}};
}

Json row_json(const ImpactRow& row) {
  return {{"kind", "impact"},
          {"response", row.response},
          {"integrator", row.integrator},
          {"stiffness", row.stiffness},
          {"elasticity", row.elasticity},
          {"omega_step", row.omega_step},
          {"kept", row.kept},
          {"most_energy", row.most_energy},
          {"position_error", row.position_error},
          {"momentum_error", row.momentum_error},
          {"spin_error", row.spin_error}};
}

Json row_json(const RestRow& row) {
  return {{"kind", "rest"},     {"bodies", row.bodies},     {"device", name_of(row.device)},    {"precision", row.precision},
          {"steps", row.steps}, {"contacts", row.contacts}, {"cut_vertices", row.cut_vertices}, {"most_a_step", row.most_a_step},
          {"drift", row.drift}};
}

Json row_json(const CostRow& row) {
  return {{"kind", "cost"},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"edges_a_step", row.edges_a_step},
          {"contacts", row.contacts},
          {"microseconds", row.microseconds},
          {"microseconds_apart", row.microseconds_apart},
          {"microseconds_without", row.microseconds_without}};
}

Json row_json(const SelfCostRow& row) {
  return {{"kind", "self"},
          {"mesh", row.mesh},
          {"device", name_of(row.device)},
          {"precision", row.precision},
          {"vertices", row.vertices},
          {"rests", row.rests},
          {"cut_vertices", row.cut_vertices},
          {"microseconds_without", row.microseconds_without},
          {"microseconds", row.microseconds}};
}

}  // namespace

std::string to_table(const ContactResult& result) {
  std::string table = lines_of<ApartRow>(
      result,
      fmt::format(
          "{:<22} {:<6} {:>4} {:>8} {:>7} {:>6} {:>6} {:>6} {:>8} {:>7} {:>5} {:>8} {:>6} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
          "apart", "device", "bits", "vertices", "edges/h", "steps", "parts", "in all", "contact", "cut", "held", "touching",
          "inside", "parted", "momentum", "and alone", "ang. mom.", "most E", "last E"));
  table +=
      lines_of<ImpactRow>(result, fmt::format("{:<9} {:<8} {:>8} {:>4} {:>11} {:>8} {:>9} {:>9} {:>9} {:>9}\n", "impact",
                                              "method", "N k", "e", "h omega", "kept", "most E", "position", "momentum", "spin"));
  table += lines_of<RestRow>(result, fmt::format("{:<22} {:<6} {:>4} {:>6} {:>8} {:>6} {:>9} {:>9}\n", "rest", "device", "bits",
                                                 "steps", "contacts", "cut", "edges/h", "drift"));
  table += lines_of<CostRow>(result, fmt::format("{:<6} {:>4} {:>8} {:>7} {:>8} {:>9} {:>9} {:>9} {:>9}\n", "cost", "bits",
                                                 "vertices", "edges/h", "contacts", "us", "apart", "more", "without"));
  table += lines_of<SelfCostRow>(result, fmt::format("{:<12} {:<6} {:>4} {:>8} {:>7} {:>6} {:>9} {:>9} {:>6}\n", "self", "device",
                                                     "bits", "vertices", "body", "cut", "us off", "us on", "ratio"));
  for (const std::string& note : result.notes) table += note + '\n';
  return table;
}

namespace {

const char* name_of(ContactStudy study) {
  switch (study) {
    case ContactStudy::apart:
      return "apart";
    case ContactStudy::impacts:
      return "impacts";
    case ContactStudy::rest:
      return "rest";
    case ContactStudy::cost:
      return "cost";
    case ContactStudy::self:
      return "self";
  }
  return "";
}

}  // namespace

std::string to_json(const Machine& machine, const ContactOptions& options, const ContactResult& result) {
  Json asked = options_json(options.devices, options.quick);
  if (options.only) asked.add("only", name_of(*options.only));
  Json file = suite_json("contact", asked, result.interrupted, machine);
  file.add("rows", list_of(result.rows, [](const ContactRow& row) {
             return std::visit([](const auto& known) { return row_json(known); }, row);
           }));
  file.add("notes", result.notes);
  return text_of(file);
}

}  // namespace pliant::bench
