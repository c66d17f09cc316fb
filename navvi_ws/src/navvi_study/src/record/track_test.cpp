#include "record/track.hpp"

#include <gtest/gtest.h>

#include "temp_folder.hpp"

namespace navvi_study::record {
namespace {

Track track_of(std::size_t rows) {
  Track track(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    track[i].time = 0.02 * static_cast<double>(i + 1);
    track[i].x = static_cast<float>(i);
    track[i].sounds = "turn";
  }
  return track;
}

TEST(Track, reads_back_and_lacks_only_a_row_that_was_cut) {
  const std::string bytes = track_npy(track_of(3));
  EXPECT_EQ(bytes.size() % 8, 0u);
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    const auto track = parse_track(std::string_view(bytes).substr(0, bytes.size() - cut));
    if (!track) continue;
    EXPECT_EQ(track->size(), 3 - (cut + sizeof(TrackRow) - 1) / sizeof(TrackRow));
    if (track->size() > 1) {
      EXPECT_EQ((*track)[1].sounds.text(), "turn");
    }
  }
  EXPECT_FALSE(parse_track("time,x,y\n"));
  EXPECT_EQ(parse_track(track_npy({}))->size(), 0u);
}

TEST(Track, that_grows_is_the_same_as_one_written_at_once) {
  const navvi_test::TempFolder folder;
  const Track all = track_of(7);
  TrackFile file(folder);
  EXPECT_FALSE(file.append({all.begin(), all.begin() + 4}));
  EXPECT_FALSE(file.append({all.begin() + 4, all.end()}));
  EXPECT_EQ(folder.text("track.npy"), track_npy(all));
}

TEST(Track, that_cannot_be_written_is_a_sentence) {
  TrackFile file("/nowhere");
  EXPECT_EQ(file.append(track_of(1)).value_or("").rfind("cannot write the track: ", 0), 0u);
}

}  // namespace
}  // namespace navvi_study::record
