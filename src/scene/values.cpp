#include "scene/values.hpp"

namespace pliant {

void convert(const toml::node& node, const std::string& path, double& value, const Range& range) {
  if (!node.is_number()) fail(node, path, fmt::format("is {}", type_name(node)), fmt::format("write {}", range.text));
  // toml++ gives no double for a whole number that it would round.
  const double number = node.is_integer() ? static_cast<double>(**node.as_integer()) : **node.as_floating_point();
  if (!(number >= range.lowest && number <= range.highest))
    fail(node, path, fmt::format("{} is out of range", number), fmt::format("write {}", range.text));
  value = number;
}

void convert(const toml::node& node, const std::string& path, unsigned& value, const Range& range) {
  double number = 0;
  convert(node, path, number, range);
  if (!node.is_integer()) fail(node, path, "is no whole number", fmt::format("write {}", range.text));
  value = static_cast<unsigned>(number);
}

void convert(const toml::node& node, const std::string& path, bool& value) {
  if (!node.is_boolean()) fail(node, path, fmt::format("is {}", type_name(node)), "write true or false");
  value = node.as_boolean()->get();
}

void convert(const toml::node& node, const std::string& path, std::string& value) {
  const auto* text = node.as_string();
  if (text == nullptr) fail(node, path, fmt::format("is {}", type_name(node)), "write a string in quotation marks");
  const bool has_control = std::ranges::any_of(text->get(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (text->get().empty() || has_control) fail(node, path, "is empty or holds a control character", "write a plain line of text");
  value = text->get();
}

void convert(const toml::node& node, const std::string& path, Named& named) {
  convert(node, path, named.value);
  named.where = origin_of(node, path);
}

}  // namespace pliant
