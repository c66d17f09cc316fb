#include "record/track.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <type_traits>
#include <utility>

namespace navvi_study::record {
namespace {

static_assert(std::is_trivially_copyable_v<TrackRow> && sizeof(TrackRow) == 184,
              "the fields below are the members of TrackRow");

constexpr const char* kFields =
    "('time','<f8'),('x','<f4'),('y','<f4'),('yaw','<f4'),('odom_x','<f4'),('odom_y','<f4'),"
    "('odom_yaw','<f4'),('speed','<f4'),('turn_rate','<f4'),('stick_forward','<f4'),"
    "('stick_left','<f4'),('motor_left','<f4'),('motor_right','<f4'),('gap','<f4'),"
    "('steer','<f4'),('asks','<u4'),('nearest','S16'),('state','S16'),('blocked_by','S16'),"
    "('cue','S32'),('sounds','S36')";
constexpr std::size_t kHead = 704;  // bytes, of the header, a multiple of 64

/// As NumPy's format 1.0 has it, always of the same length.
std::string head_of(std::size_t rows) {
  std::string count = std::to_string(rows);
  count.insert(0, 20 - count.size(), ' ');
  std::string text = std::string("{'descr':[") + kFields + "],'fortran_order':False,'shape':(" +
                     count + ",)}";
  text.append(kHead - 10 - 1 - text.size(), ' ');
  constexpr std::size_t kLength = kHead - 10;
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(kLength & 255) +
         static_cast<char>(kLength >> 8) + text + '\n';
}

std::string_view bytes_of(const Track& rows) {
  return {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(TrackRow)};
}

}  // namespace

std::string track_npy(const Track& track) {
  return head_of(track.size()).append(bytes_of(track));
}

std::optional<Track> parse_track(std::string_view bytes) {
  const std::string head = head_of(0);
  // The count may lag behind the rows where the writer was killed.
  const std::size_t same = head.rfind("'shape'");
  if (bytes.size() < kHead || bytes.substr(0, same) != head.substr(0, same)) return std::nullopt;
  bytes.remove_prefix(kHead);
  Track track(bytes.size() / sizeof(TrackRow));
  if (!track.empty()) std::memcpy(track.data(), bytes.data(), track.size() * sizeof(TrackRow));
  // What a loss of power took out of the middle reads as zeros.
  double last = 0.0;
  const auto follows = [&](const auto& row) { return row.time > std::exchange(last, row.time); };
  track.erase(std::find_if_not(track.begin(), track.end(), follows), track.end());
  return track;
}

Track read_track(const std::filesystem::path& folder) {
  const auto bytes = navvi_files::read_file(folder / "track.npy");
  return bytes ? parse_track(*bytes).value_or(Track()) : Track();
}

TrackFile::TrackFile(const std::filesystem::path& folder, navvi_files::SystemCalls calls)
    : calls_(std::move(calls)),
      file_(::open((folder / "track.npy").c_str(),
                   O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644)) {}

TrackFile::~TrackFile() {
  if (file_ >= 0) ::close(file_);
}

navvi_files::Problem TrackFile::append(const Track& rows) {
  unwritten_.insert(unwritten_.end(), rows.begin(), rows.end());
  int error = write_at(kHead + rows_ * sizeof(TrackRow), bytes_of(unwritten_));
  if (error == 0) {
    rows_ += unwritten_.size();
    unwritten_.clear();
    error = write_at(0, head_of(rows_));
  }
  if (error != 0) return navvi_files::failure("write the track", error);
  return std::nullopt;
}

navvi_files::Problem TrackFile::sync() {
  if (auto problem = append({})) return problem;
  if (calls_.fdatasync(file_) == 0) return std::nullopt;
  return navvi_files::failure("sync the track", errno);
}

int TrackFile::write_at(std::size_t place, std::string_view bytes) {
  if (::lseek(file_, static_cast<off_t>(place), SEEK_SET) < 0) return errno;
  return navvi_files::write_all(file_, bytes, calls_);
}

}  // namespace navvi_study::record
