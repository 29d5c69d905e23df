#include "support/json.hpp"

#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

namespace pliant::test {

ReadJson ReadJson::parse(std::string_view text) { return ReadJson(std::make_shared<const Value>(Value::parse(text))); }

ReadJson::ReadJson(bool value) : value_(std::make_shared<const Value>(value)) {}
ReadJson::ReadJson(double value) : value_(std::make_shared<const Value>(value)) {}
ReadJson::ReadJson(const char* text) : value_(std::make_shared<const Value>(text)) {}
ReadJson::ReadJson(const std::string& text) : value_(std::make_shared<const Value>(text)) {}

ReadJson::ReadJson(const std::vector<ReadJson>& elements) {
  Value array = Value::array();
  for (const ReadJson& element : elements) array.push_back(*element.value_);
  value_ = std::make_shared<const Value>(std::move(array));
}

std::shared_ptr<const ReadJson::Value> ReadJson::whole(std::int64_t value) { return std::make_shared<const Value>(value); }
std::shared_ptr<const ReadJson::Value> ReadJson::whole(std::uint64_t value) { return std::make_shared<const Value>(value); }

ReadJson ReadJson::part(const Value& value) const { return ReadJson(std::shared_ptr<const Value>(value_, &value)); }

ReadJson ReadJson::operator[](std::string_view key) const { return part(value_->at(std::string(key))); }
ReadJson ReadJson::operator[](std::size_t index) const { return part(value_->at(index)); }
ReadJson ReadJson::back() const { return part(value_->at(size() - 1)); }
bool ReadJson::contains(std::string_view key) const { return value_->contains(std::string(key)); }

std::vector<std::string> ReadJson::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : value_->get_ref<const Value::object_t&>()) keys.push_back(key);
  return keys;
}

ReadJson ReadJson::without(std::string_view key) const {
  Value copy = *value_;
  copy.erase(std::string(key));
  return ReadJson(std::make_shared<const Value>(std::move(copy)));
}

std::size_t ReadJson::size() const { return value_->size(); }

bool ReadJson::is_null() const { return value_->is_null(); }
bool ReadJson::is_number() const { return value_->is_number(); }
bool ReadJson::is_number_unsigned() const { return value_->is_number_unsigned(); }
bool ReadJson::is_object() const { return value_->is_object(); }
bool ReadJson::is_string() const { return value_->is_string(); }

template <class T>
T ReadJson::get() const {
  return value_->get<T>();
}
template bool ReadJson::get() const;
template double ReadJson::get() const;
template std::uint32_t ReadJson::get() const;
template std::uint64_t ReadJson::get() const;
template std::string ReadJson::get() const;

std::string ReadJson::text() const { return value_->dump(); }

bool operator==(const ReadJson& a, const ReadJson& b) { return *a.value_ == *b.value_; }

std::partial_ordering operator<=>(const ReadJson& a, const ReadJson& b) {
  if (!a.is_number() || !b.is_number()) throw std::invalid_argument(a.text() + " and " + b.text() + " have no order");
  if (*a.value_ == *b.value_) return std::partial_ordering::equivalent;
  if (*a.value_ < *b.value_) return std::partial_ordering::less;
  return *b.value_ < *a.value_ ? std::partial_ordering::greater : std::partial_ordering::unordered;
}

std::ostream& operator<<(std::ostream& out, const ReadJson& json) { return out << json.text(); }

}  // namespace pliant::test
