#pragma once

#include <ros/serialization.h>

#include "fuzz.hpp"

namespace navvi_test {

/// As roscpp's, but an array is no larger than what is left of the message.
struct CheckedStream : ros::serialization::Stream {
  static constexpr auto stream_type = ros::serialization::stream_types::Input;

  explicit CheckedStream(std::string& bytes) : Stream(begin(bytes), size(bytes)) {}
  static std::uint8_t* begin(std::string& bytes) { return reinterpret_cast<std::uint8_t*>(bytes.data()); }
  static std::uint32_t size(const std::string& bytes) { return static_cast<std::uint32_t>(bytes.size()); }
  template <typename T>
  void next(T& value) {
    ros::serialization::deserialize(*this, value);
  }
  template <typename T>
  void next(std::vector<T>& values) {
    std::uint32_t size = 0;
    next(size);
    if (size > getLength()) ros::serialization::throwStreamOverrun();
    values.resize(size);
    for (T& value : values) next(value);
  }
};

template <typename Message>
std::string bytes_of(const Message& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream out(CheckedStream::begin(bytes), CheckedStream::size(bytes));
  ros::serialization::serialize(out, message);
  return bytes;
}

/// Gives damaged messages to what takes them, as fuzz_bytes() does; roscpp drops those that are too short for their type.
template <typename Message, typename Take>
void fuzz_message(const Message& whole, const Take& take) {
  fuzz_bytes({bytes_of(whole)}, [&take](std::string bytes) {
    Message message;
    try {
      CheckedStream stream(bytes);
      stream.next(message);
    } catch (const ros::serialization::StreamOverrunException&) {
      return;
    }
    take(message);
  });
}

}  // namespace navvi_test
