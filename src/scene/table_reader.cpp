#include "scene/table_reader.hpp"

#include <algorithm>

namespace pliant {

void TableReader::require(const char* key) const {
  if (peek(key) == nullptr) fail(table_, path_, fmt::format("has no {}", key), fmt::format("add {} = ...", key));
}

void TableReader::keep_one_of(const char* first, const char* second) {
  const toml::node *one = peek(first), *other = peek(second);
  if (one == nullptr || other == nullptr) return;
  const auto rank = [&](const char* key, const toml::node& node) { return std::pair(is_override(node), is_in_front(key)); };
  if (rank(first, *one) == rank(second, *other))
    fail(*other, path_of(second), fmt::format("can't be combined with {}", first), "keep one of them");
  replaced_.emplace_back(rank(first, *one) > rank(second, *other) ? second : first);
}

const toml::node* TableReader::peek(const char* key) const {
  if (std::ranges::find(replaced_, key) != replaced_.end()) return nullptr;
  return is_in_front(key) ? front_->get(key) : table_.get(key);
}

bool TableReader::is_in_front(std::string_view key) const {
  const toml::node* const in_front = front_ == nullptr ? nullptr : front_->get(key);
  const toml::node* const behind = table_.get(key);
  return in_front != nullptr && (behind == nullptr || is_override(*in_front) || !is_override(*behind));
}

void TableReader::forget_behind(std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (front_ == nullptr || front_->get(key) == nullptr) replaced_.emplace_back(key);
}

const toml::node* TableReader::find(const char* key) {
  know(key);
  return peek(key);
}

Origin TableReader::where(const char* key) const {
  const toml::node* node = peek(key);
  return node == nullptr ? Origin() : origin_of(*node, path_of(key));
}

void TableReader::note(std::initializer_list<const char*> keys, std::vector<Origin>& found) const {
  for (const char* key : keys)
    if (peek(key) != nullptr) found.push_back(where(key));
}

std::string TableReader::path_of(std::string_view key) const {
  const std::string& path = is_in_front(key) ? front_path_ : path_;
  return fmt::format("{}{}{}", path, path.empty() ? "" : ".", key);
}

void TableReader::finish() const {
  for (const auto& [key, node] : table_)
    if (front_path_.empty() || !key.str().starts_with('[')) expect_known(key.str(), node);  // other bodies in the rows
  if (front_ == nullptr) return;
  for (const auto& [key, node] : *front_) expect_known(key.str(), node);
}

void TableReader::expect_known(std::string_view key, const toml::node& node) const {
  if (std::ranges::find(known_, key) == known_.end()) fail(node, path_of(key), "unknown key", suggest(key, known_));
}

}  // namespace pliant
