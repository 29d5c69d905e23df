// Snapshots kept, found and let go.
#include "view/history.hpp"

#include <catch2/catch.hpp>

using namespace pliant;
using namespace pliant::view;

namespace {

Snapshot snapshot(std::uint64_t step, std::size_t bytes = 1000) { return {step, std::string(bytes, static_cast<char>(step))}; }

TEST_CASE("the snapshot before a step is the latest one earlier than it") {
  History history(1 << 20);
  CHECK(history.before(10) == nullptr);
  for (const std::uint64_t step : {0, 3, 4, 9}) history.record(snapshot(step));
  CHECK(history.before(0) == nullptr);
  CHECK(history.before(1)->step == 0);
  CHECK(history.before(4)->step == 3);
  CHECK(history.before(9)->step == 4);
  CHECK(history.before(1000)->step == 9);
  CHECK(history.before(1000)->saved == snapshot(9).saved);
}

TEST_CASE("what is recorded after going back replaces what came after") {
  History history(1 << 20);
  for (const std::uint64_t step : {0, 3, 4, 9}) history.record(snapshot(step));
  history.record(snapshot(4));
  CHECK(history.size() == 3);
  CHECK(history.before(1000)->step == 4);
}

TEST_CASE("memory is bounded, and the oldest snapshots go first") {
  const std::size_t each = snapshot(0).bytes(), most = 10 * each + each / 2;
  CHECK(each >= 1000);
  History history(most);
  for (std::uint64_t step = 0; step < 1000; ++step) {
    history.record(snapshot(step));
    CHECK(history.bytes() <= most);
  }
  CHECK(history.size() == 10);
  CHECK(history.before(990) == nullptr);
  CHECK(history.before(991)->step == 990);
  history.clear();
  CHECK(history.bytes() == 0);
  CHECK(history.before(1000) == nullptr);
}

TEST_CASE("one snapshot is kept even where it alone is over the bound") {
  History history(1);
  history.record(snapshot(0));
  history.record(snapshot(1));
  CHECK(history.size() == 1);
  CHECK(history.before(2)->step == 1);
}

}  // namespace
