#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace navvi_floor {

/// Numbers the pieces of a grid whose cells hang together, from 1 on by their first cells, row by
/// row; 0: in none.
/// \param in  whether a cell, by its number, is in a piece
/// \param corner  1 where cells that share a corner hang together, 0 where they must share a side
template <typename In>
std::vector<std::uint32_t> pieces_of(std::size_t width, std::size_t height, std::size_t corner,
                                     const In& in) {
  struct Run {
    std::size_t begin, end;
    std::size_t joins;  // a run before it, or itself
  };
  std::vector<Run> runs;
  const auto first = [&runs](std::size_t run) {
    while (runs[run].joins != run) run = runs[run].joins = runs[runs[run].joins].joins;
    return run;
  };
  std::size_t above = 0;
  for (std::size_t row = 0; row < width * height; row += width) {
    for (std::size_t at = row; at < row + width; ++at) {
      const std::size_t begin = at, one = runs.size();
      while (at < row + width && in(at)) ++at;
      if (at == begin) continue;
      runs.push_back({begin, at, one});
      while (runs[above].end + width + (begin > row ? corner : 0) <= begin) ++above;
      const std::size_t end = std::min(at + corner, row + width);
      for (std::size_t other = above; runs[other].begin + width < end; ++other) {
        const auto [before, after] = std::minmax({first(other), first(one)});
        runs[after].joins = before;
      }
    }
  }
  std::vector<std::uint32_t> out(width * height, 0), number(runs.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    number[i] = runs[i].joins == i ? ++count : number[first(i)];
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(runs[i].begin),
              out.begin() + static_cast<std::ptrdiff_t>(runs[i].end), number[i]);
  }
  return out;
}

}  // namespace navvi_floor
