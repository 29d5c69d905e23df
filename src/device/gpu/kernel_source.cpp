#include "device/gpu/kernel_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "device/array_list.hpp"

namespace pliant::gpu {

// Behind those of arrays, because pictures have a block of constants at 0 and may be drawn between steps.
std::size_t binding_of(std::span<const KernelSignature::Array> arrays, std::size_t place) {
  const auto is_constant = [](const KernelSignature::Array& array) { return array.use == ArrayUse::constants; };
  const auto constants = static_cast<std::size_t>(std::ranges::count_if(arrays.first(place), is_constant));
  return is_constant(arrays[place]) ? max_arrays + constants : place - constants;
}

namespace {

/// `WORD(argument, argument)` and what follows on the line.
struct Declaration {
  std::string_view word;
  std::vector<std::string_view> arguments;
  std::string_view rest;
};

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text.substr(0, text.find_last_not_of(" \t") + 1);
}

std::vector<std::string_view> split(std::string_view list) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = list.find(',');
    parts.push_back(trimmed(list.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    list.remove_prefix(comma + 1);
  }
}

struct Form {
  std::string_view word;
  std::size_t argument_count;
};

std::optional<Declaration> parse_declaration(std::string_view line) {
  constexpr Form forms[] = {{"READ", 1},     {"WRITE", 1},           {"SHARED_WRITE", 1}, {"READ_AS", 3},
                            {"WRITE_AS", 3}, {"SHARED_WRITE_AS", 3}, {"CONSTANTS", 2},    {"PARAMETER", 2}};
  const std::size_t open = line.find('('), close = line.find(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
  Declaration found{trimmed(line.substr(0, open)), split(line.substr(open + 1, close - open - 1)), line.substr(close + 1)};
  const auto fits = [&](const Form& form) { return found.word == form.word && found.arguments.size() == form.argument_count; };
  return std::ranges::any_of(forms, fits) ? std::optional(found) : std::nullopt;
}

/// Returns the place of the row with this name, and adds it if there is none.
template <class Row>
std::size_t place_of(std::vector<Row>& rows, const Row& row) {
  const auto found = std::ranges::find(rows, row.name, &Row::name);
  if (found != rows.end()) return static_cast<std::size_t>(found - rows.begin());
  rows.push_back(row);
  return rows.size() - 1;
}

class Writer {
 public:
  explicit Writer(KernelSignature& signature) : signature_(signature) {}

  std::string write_out(const Declaration& declaration, const gl::FlatShader::Origin& origin) {
    const auto& [word, arguments, rest] = declaration;
    if (word == "PARAMETER") return parameter(arguments[0], arguments[1]) + std::string(rest);
    const ArrayRow* const array = find_array(arguments[0]);
    if (array == nullptr)
      throw Error(ErrorKind::device, fmt::format("{}:{}", origin.file, origin.line),
                  fmt::format("there is no array \"{}\"", arguments[0]), "add it to physics/arrays.glsl");
    if (word == "CONSTANTS") return constants(*array, arguments[1]) + std::string(rest);
    const bool has_view = arguments.size() == 3;
    return block(word, *array, has_view ? arguments[1] : std::string_view(), has_view ? arguments[2] : array->name) +
           std::string(rest);
  }

 private:
  std::string parameter(std::string_view type, std::string_view name) {
    const std::size_t location = place_of(signature_.parameters, {std::string(name), type == "double"});
    return fmt::format("layout(location = {}) uniform {} {};", location, type, name);
  }

  std::string block(std::string_view word, const ArrayRow& array, std::string_view view, std::string_view name) {
    const bool is_read = word.starts_with("READ");
    const std::size_t place = place_of(signature_.arrays, {std::string(name), std::string(array.name),
                                                           is_read ? ArrayUse::read : ArrayUse::write, std::string(view)});
    const std::string_view qualifier = is_read ? "readonly " : word.starts_with("SHARED") ? "coherent " : "";
    return fmt::format("layout(std430, binding = {}) {}buffer {}_block {{ {} {}[]; }};", binding_of(signature_.arrays, place),
                       qualifier, name, view.empty() ? array.element : view, name);
  }

  std::string constants(const ArrayRow& array, std::string_view count) {
    const std::size_t place =
        place_of(signature_.arrays, {std::string(array.name), std::string(array.name), ArrayUse::constants, {}});
    return fmt::format("layout(std140, binding = {}) uniform {}_block {{ {} {}[{}]; }};", binding_of(signature_.arrays, place),
                       array.name, array.element, array.name, count);
  }

  KernelSignature& signature_;
};

std::string_view kernel_file(std::span<const gl::Define> defines) {
  const auto found = std::ranges::find(defines, "@kernel", &gl::Define::first);
  return found == defines.end() ? std::string_view() : std::string_view(found->second);
}

}  // namespace

KernelSource kernel_source(std::span<const gl::ShaderFile> files, std::string_view frame, std::span<const gl::Define> defines) {
  KernelSource source{gl::flatten_shader(files, frame, defines), {}};
  Writer writer(source.signature);
  std::string text;
  std::size_t number = 0;
  for (std::string_view left = source.shader.text; !left.empty(); ++number) {
    const std::string_view line = left.substr(0, left.find('\n'));
    left.remove_prefix(line.size() + 1);
    const std::optional<Declaration> declaration = parse_declaration(line);
    text += declaration ? writer.write_out(*declaration, source.shader.origins[number]) : std::string(line);
    text += '\n';
  }
  const std::vector<KernelSignature::Array>& arrays = source.signature.arrays;
  const auto constants = static_cast<std::size_t>(std::ranges::count(arrays, ArrayUse::constants, &KernelSignature::Array::use));
  if (arrays.size() - constants > max_arrays || constants > max_constants)
    throw Error(ErrorKind::device, std::string(kernel_file(defines)),
                fmt::format("the kernel has {} arrays and {} of constants, but it may have {} and {}", arrays.size() - constants,
                            constants, max_arrays, max_constants),
                "make two kernels of it");
  source.shader.text = std::move(text);
  return source;
}

}  // namespace pliant::gpu
