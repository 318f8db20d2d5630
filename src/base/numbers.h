#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace telestrain {

// Locale-independent text of a double: the shortest that reads back to the same value.
std::string FormatShortest(double value);

// Fixed notation with `decimals` digits behind the point; "-0.00" becomes "0.00".
std::string FormatFixed(double value, int decimals);

// The whole text as a finite number (decimal point, optional exponent), or nothing.
std::optional<double> ParseDouble(std::string_view text);
std::optional<int> ParseInt(std::string_view text);

// The candidate with the smallest edit distance to `word`, for "did you mean" in errors.
template <typename Range>
std::string NearestWord(std::string_view word, const Range& candidates);

// Levenshtein distance in bytes.
int EditDistance(std::string_view a, std::string_view b);

template <typename Range>
std::string NearestWord(std::string_view word, const Range& candidates) {
  std::string nearest;
  int best = 1 << 30;
  for (const auto& candidate : candidates) {
    const int distance = EditDistance(word, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

// The middle value; of an even number of values the upper of the two. Not of none.
double Median(std::vector<double> values);

// "1 corner", "2 corners".
std::string CountText(std::size_t number, const std::string& noun);

}  // namespace telestrain
