#include "surefoot/logging/change_count.hpp"

#include "surefoot/logging/json_cursor.hpp"
#include "surefoot/logging/message_decoder.hpp"

namespace surefoot {

void ChangeCount::add(const logged::Change& change) {
  if (change.kind != "pull") {
    ++count_;
    return;
  }
  const std::string body = change.force.isZero() ? "" : change.body;
  if (!body.empty() && body != pulled_) ++count_;
  pulled_ = body;
}

void ChangeCount::add(std::string_view message) {
  logged::Change change;
  try {
    logged::Decoder::decode(message, change);
  } catch (const JsonError&) {
    change = {};
  }
  add(change);
}

}  // namespace surefoot
