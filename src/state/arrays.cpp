#include "state/arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace pliant {
namespace {

const ArrayRow& row_of(std::string_view name) {
  const ArrayRow* const row = find_array(name);
  if (row == nullptr) throw std::logic_error(fmt::format("there is no array \"{}\" in physics/arrays.glsl", name));
  return *row;
}

const Parameter* find_parameter(const Arrays& arrays, const Parameters& own, std::string_view name) {
  const auto found = std::ranges::find(own, name, &Parameters::value_type::first);
  return found != own.end() ? &found->second : arrays.parameter(name);
}

Parameter parameter_of(const Arrays& arrays, std::string_view kernel, const Parameters& own,
                       const KernelSignature::Number& declared, std::uint32_t item_count) {
  const Parameter count = item_count;
  const Parameter* const value = declared.name == "item_count" ? &count : find_parameter(arrays, own, declared.name);
  if (value == nullptr) throw std::logic_error(fmt::format("{}: the parameter \"{}\" has no value", kernel, declared.name));
  if (std::holds_alternative<double>(*value) != declared.is_double)
    throw std::logic_error(
        fmt::format("{}: the parameter \"{}\" is of type {}", kernel, declared.name, declared.is_double ? "double" : "uint"));
  return *value;
}

std::logic_error not_made(std::string_view name) {
  return std::logic_error(fmt::format("nobody has made the array \"{}\"", name));
}

void expect_declared(std::string_view kernel, const KernelSignature& signature, const Parameters& own) {
  for (const auto& [name, value] : own)
    if (std::ranges::find(signature.parameters, name, &KernelSignature::Number::name) == signature.parameters.end())
      throw std::logic_error(fmt::format("{}: the kernel declares no parameter \"{}\"", kernel, name));
}

// The type of the numbers that an element consists of. A struct is its own.
std::string_view number_of(std::string_view element) {
  if (element == "WholeSum") return "uint";  // two of them, also where a kernel takes both as one (contact/exact_sum.glsl)
  constexpr std::pair<std::string_view, std::string_view> vectors[] = {
      {"vec", "float"}, {"uvec", "uint"}, {"dvec", "double"}, {"real", "real"}};
  const std::size_t last = element.size() - 1;
  if (element.find_first_of("234") != last) return element;
  const auto* const found =
      std::ranges::find(vectors, element.substr(0, last), &std::pair<std::string_view, std::string_view>::first);
  return found == std::end(vectors) ? element : found->second;
}

// A view may take the same numbers in other groups, as placements are read four at a time.
void expect_view(const KernelSignature::Array& declared) {
  const std::string_view listed = find_array(declared.array)->element;
  if (!declared.view.empty() && number_of(declared.view) != number_of(listed))
    throw std::logic_error(
        fmt::format("the array \"{}\" has elements {}, which no {} can view", declared.array, listed, declared.view));
}

}  // namespace

DeviceArray<std::uint32_t>& Arrays::make_reals(std::string_view name, std::size_t count, Content content) {
  const std::size_t words = count * static_cast<std::size_t>(device_.precision()) / 32;
  return hold(name, "real", allocate<std::uint32_t>(name, words, content));
}

void Arrays::expect_element(std::string_view name, std::string_view element) {
  const std::string_view listed = row_of(name).element;
  if (listed != element) throw std::logic_error(fmt::format("the array \"{}\" has elements {}, not {}", name, listed, element));
}

const Arrays::Held& Arrays::find(std::string_view name, std::string_view element) const {
  if (!element.empty()) expect_element(name, element);
  const auto found = held_.find(name);
  if (found == held_.end()) throw not_made(name);
  return found->second;
}

BufferId Arrays::buffer(std::string_view name) const { return find(name, {}).bytes.buffer; }

std::vector<BufferId> Arrays::made_buffers(std::span<const std::string_view> names) const {
  std::vector<BufferId> buffers;
  for (const std::string_view name : names)
    if (const auto found = held_.find(name); found != held_.end()) buffers.push_back(found->second.bytes.buffer);
  return buffers;
}

const Parameter* Arrays::parameter(std::string_view name) const {
  const auto found = parameters_.find(name);
  return found == parameters_.end() ? nullptr : &found->second;
}

void Arrays::carry_part(std::string_view name, std::size_t first_byte, std::size_t byte_count) {
  const auto found = held_.find(name);
  if (found == held_.end()) throw not_made(name);
  found->second.bytes.first_byte = first_byte;
  found->second.bytes.byte_count = byte_count;
}

std::vector<CarriedArray> Arrays::carried() const {
  std::vector<CarriedArray> carried;
  for (const ArrayRow& row : array_list())
    if (const auto found = held_.find(row.name); row.life == ArrayLife::carried && found != held_.end())
      carried.push_back(found->second.bytes);
  return carried;
}

Pass make_pass(const Arrays& arrays, std::string_view name, const Parameters& parameters, std::uint32_t item_count) {
  return make_pass(arrays, name, arrays.device().kernel(name), parameters, item_count);
}

Pass make_pass(const Arrays& arrays, std::string_view name, KernelId kernel, const Parameters& parameters,
               std::uint32_t item_count) {
  const KernelSignature& signature = arrays.device().signature(kernel);
  expect_declared(name, signature, parameters);
  Pass pass{.name = name, .call = {.kernel = kernel, .buffers = {}, .parameters = {}}, .item_count = item_count};
  try {
    expect_apart(signature.arrays);
    for (const auto& array : signature.arrays) {
      pass.call.buffers.push_back(arrays.buffer(array.array));
      expect_view(array);
    }
  } catch (const std::logic_error& error) {
    throw std::logic_error(fmt::format("{}: {}", name, error.what()));
  }
  for (const auto& number : signature.parameters)
    pass.call.parameters.push_back(parameter_of(arrays, name, parameters, number, item_count));
  return pass;
}

Pass make_round_pass(const Arrays& arrays, std::string_view name, const Parameters& parameters) {
  Device& device = arrays.device();
  const KernelId kernel = device.round_kernel(name);
  return make_pass(arrays, name, kernel, parameters, device.groups_at_once(kernel));
}

}  // namespace pliant
