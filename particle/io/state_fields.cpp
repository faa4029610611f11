#include "particle/io/state_fields.hpp"

#include "particle/io/restart_error.hpp"

namespace surge {

const StateField& StateReader::next(const std::string& name, const std::string& type,
                                    std::size_t value_bytes) {
  const std::string expected = name + " (" + type + ")";
  if (at_ == fields_.size()) refuse(expected, "no such field");
  const StateField& field = fields_[at_++];
  if (field.name != name || field.type != type || field.value_bytes != value_bytes)
    refuse(expected, "field " + field.name + " (" + field.type + ")");
  return field;
}

void StateReader::take(std::byte* data, std::size_t bytes) {
  stream_.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(bytes));
  if (!stream_) refuse(fields_[at_ - 1].name, "no more bytes");
}

void StateReader::finish() const {
  if (at_ < fields_.size()) refuse("no more fields", "field " + fields_[at_].name);
}

void StateReader::refuse(const std::string& field, const std::string& found) const {
  throw RestartError(file_.string() + ": state: found " + found + ", expected " + field +
                     ": the state of another version or case; --force starts anew");
}

}  // namespace surge
