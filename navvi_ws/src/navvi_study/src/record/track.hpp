#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <navvi_files/files.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navvi_study::record {

/// A word of at most so many letters; longer ones are cut off.
template <std::size_t Size>
struct Word {
  std::array<char, Size> letters{};

  Word() = default;
  template <typename Text>
  // NOLINTNEXTLINE(google-explicit-constructor): a word is written as one
  Word(const Text& word) {
    std::string_view(word).copy(letters.data(), Size);
  }
  [[nodiscard]] bool empty() const { return letters[0] == '\0'; }
  [[nodiscard]] std::string text() const { return {letters.data(), ::strnlen(letters.data(), Size)}; }
};

/// A robot and its person at one instant, as it stands in track.npy. What has no value is NaN or
/// an empty word.
struct TrackRow {
  double time = 0.0;                             ///< s, ROS time
  float x = 0.0F, y = 0.0F, yaw = 0.0F;          ///< m and rad, in map
  float odom_x = 0.0F, odom_y = 0.0F, odom_yaw = 0.0F;  ///< likewise, by odometry alone
  float speed = 0.0F;                            ///< m/s, forward
  float turn_rate = 0.0F;                        ///< rad/s, counter-clockwise
  float stick_forward = 0.0F, stick_left = 0.0F; ///< [-1, 1]
  float motor_left = 0.0F, motor_right = 0.0F;   ///< [0, 1]
  float gap = 0.0F;                              ///< m, from the hull to the nearest thing
  float steer = 0.0F;                            ///< rad, clockwise from the nose to where to steer
  std::uint32_t asks = 0;                        ///< 1: the person asks for the direction again
  Word<16> nearest;                              ///< class of the nearest thing
  Word<16> state;                                ///< of the guidance
  Word<16> blocked_by;                           ///< class
  Word<32> cue;                                  ///< kind that begins to be spoken since the last row
  Word<36> sounds;                               ///< that begin since then
};

using Track = std::vector<TrackRow>;

constexpr double kTrackRate = 50.0;  ///< Hz

/// As NumPy reads it by numpy.load(): an array with a named field a member of TrackRow.
[[nodiscard]] std::string track_npy(const Track& track);
/// The rows up to the first that is not whole. nullopt for bytes that track_npy() does not write.
[[nodiscard]] std::optional<Track> parse_track(std::string_view bytes);
/// track.npy of a trial's folder; empty where it is missing or damaged from its beginning.
[[nodiscard]] Track read_track(const std::filesystem::path& folder);

/// track.npy of a trial that runs.
class TrackFile {
 public:
  explicit TrackFile(const std::filesystem::path& folder,
                     navvi_files::SystemCalls calls = navvi_files::SystemCalls::real());
  ~TrackFile();
  TrackFile(const TrackFile&) = delete;
  TrackFile& operator=(const TrackFile&) = delete;

  /// From now on the file holds these, too; what could not be written is tried again the next time.
  [[nodiscard]] navvi_files::Problem append(const Track& rows);
  /// Makes all of them last through a loss of power.
  [[nodiscard]] navvi_files::Problem sync();

 private:
  /// errno, or 0
  [[nodiscard]] int write_at(std::size_t place, std::string_view bytes);

  navvi_files::SystemCalls calls_;
  int file_;
  std::size_t rows_ = 0;
  Track unwritten_;
};

}  // namespace navvi_study::record
