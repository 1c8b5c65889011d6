#include "math/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace swell {
namespace {

// Steele, Lea, Flood's SplitMix64 as published: a state that steps by the golden gamma.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t state) : state_(state) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

// The sum of (observed - expected)^2 / expected.
double chi_square(const std::vector<int>& counts, double expected) {
  double sum = 0.0;
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// True within about five standard deviations of a chi-square with this many degrees of freedom.
bool plausible_chi_square(double value, double freedom) {
  return std::abs(value - freedom) < 5.0 * std::sqrt(2.0 * freedom);
}

TEST(RandomBits, AreThePublishedSplitMix64StreamSeededByItself) {
  // The first outputs for the state 1234567, as listed with other implementations.
  SplitMix64 known(1234567);
  EXPECT_EQ(known.next(), 6457827717110365317u);
  EXPECT_EQ(known.next(), 3203168211198807973u);

  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{7}, ~std::uint64_t{0}}) {
    const std::uint64_t state = SplitMix64(seed).next();
    SplitMix64 stream(state - 0x9e3779b97f4a7c15u);  // so that counter 0 mixes the state itself
    for (std::uint64_t counter = 0; counter < 100; ++counter) {
      ASSERT_EQ(random_bits(seed, counter), stream.next()) << seed << " " << counter;
    }
  }
}

TEST(RandomBits, AreTheSameForEver) {
  static_assert(random_bits(1, 2) == random_bits(1, 2));
  EXPECT_EQ(random_bits(0, 0), 5197578548964807871u);
  EXPECT_EQ(random_bits(1, 0), 15916886550466581944u);
  EXPECT_EQ(random_bits(42, 1000000007), 3033562943382215949u);
}

TEST(RandomBits, ChangeHalfTheirBitsWithEachBitOfSeedAndCounter) {
  constexpr int kTrials = 400;
  for (int bit = 0; bit < 64; ++bit) {
    int seed_flips = 0, counter_flips = 0;
    for (std::uint64_t i = 0; i < kTrials; ++i) {
      const std::uint64_t mask = std::uint64_t{1} << bit;
      seed_flips += std::popcount(random_bits(i, 99) ^ random_bits(i ^ mask, 99));
      counter_flips += std::popcount(random_bits(99, i) ^ random_bits(99, i ^ mask));
    }
    // 64 * 400 coins: standard deviation 80.
    EXPECT_NEAR(seed_flips, 32 * kTrials, 400) << bit;
    EXPECT_NEAR(counter_flips, 32 * kTrials, 400) << bit;
  }
}

TEST(RandomUniform, LiesInTheHalfOpenUnitIntervalOnTheDyadicGrid) {
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const double u = random_uniform(3, i);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ASSERT_EQ(u * 0x1p53, std::floor(u * 0x1p53));
  }
}

TEST(RandomUniform, PassesAChiSquareTest) {
  constexpr int kBins = 1000, kDraws = 500000;
  for (const std::uint64_t seed : {0u, 1u, 12345u}) {
    std::vector<int> counts(kBins);
    for (std::uint64_t i = 0; i < kDraws; ++i) {
      ++counts[static_cast<std::size_t>(random_uniform(seed, i) * kBins)];
    }
    EXPECT_TRUE(plausible_chi_square(chi_square(counts, double{kDraws} / kBins), kBins - 1))
        << seed;
  }
}

TEST(RandomUniform, NeighbouringCountersAndSeedsAreIndependent) {
  constexpr int kSide = 32, kDraws = 200000;
  std::vector<int> by_counter(kSide * kSide), by_seed(kSide * kSide);
  const auto cell = [](double u, double v) {
    return static_cast<std::size_t>(static_cast<int>(u * kSide) * kSide +
                                    static_cast<int>(v * kSide));
  };
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    ++by_counter[cell(random_uniform(5, 2 * i), random_uniform(5, 2 * i + 1))];
    ++by_seed[cell(random_uniform(i, 5), random_uniform(i + 1, 5))];
  }
  const double expected = double{kDraws} / (kSide * kSide);
  EXPECT_TRUE(plausible_chi_square(chi_square(by_counter, expected), kSide * kSide - 1));
  EXPECT_TRUE(plausible_chi_square(chi_square(by_seed, expected), kSide * kSide - 1));
}

TEST(RandomUniform, SmallSeedsAndCountersNeverCollide) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    for (std::uint64_t i = 0; i < 200; ++i) seen.insert(random_bits(seed, i));
  }
  EXPECT_EQ(seen.size(), 200u * 200u);
}

std::vector<double> gaussian_numbers(std::uint64_t seed, std::uint64_t pairs) {
  std::vector<double> x;
  for (std::uint64_t n = 0; n < pairs; ++n) {
    const GaussianPair pair = random_gaussian_pair(seed, n);
    x.insert(x.end(), {pair.first, pair.second});
  }
  return x;
}

TEST(RandomGaussianPair, IsTheBoxMullerTransformOfItsTwoCounters) {
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const double u = random_uniform(8, 2 * n), v = random_uniform(8, 2 * n + 1);
    const double radius = std::sqrt(-2.0 * std::log(u));
    const GaussianPair pair = random_gaussian_pair(8, n);
    ASSERT_NEAR(pair.first, radius * std::cos(2.0 * 3.14159265358979323846 * v), 1e-13);
    ASSERT_NEAR(pair.second, radius * std::sin(2.0 * 3.14159265358979323846 * v), 1e-13);
  }
}

TEST(RandomGaussianPair, HasTheMomentsOfTheStandardNormal) {
  const std::vector<double> x = gaussian_numbers(11, 200000);
  const double n = static_cast<double>(x.size());
  std::array<double, 5> moment{};
  for (const double v : x) {
    for (std::size_t k = 1; k <= 4; ++k) moment[k] += std::pow(v, static_cast<double>(k)) / n;
  }
  // Five standard deviations of each sample moment: sqrt(1, 2, 15, 96) / sqrt(n).
  const double five = 5.0 / std::sqrt(n);
  EXPECT_NEAR(moment[1], 0.0, five);
  EXPECT_NEAR(moment[2], 1.0, five * std::sqrt(2.0));
  EXPECT_NEAR(moment[3], 0.0, five * std::sqrt(15.0));
  EXPECT_NEAR(moment[4], 3.0, five * std::sqrt(96.0));
}

TEST(RandomGaussianPair, PassesAKolmogorovSmirnovTest) {
  std::vector<double> x = gaussian_numbers(12, 100000);
  std::sort(x.begin(), x.end());
  const double n = static_cast<double>(x.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double cdf = 0.5 * std::erfc(-x[i] / std::sqrt(2.0));
    distance = std::max({distance, std::abs(cdf - static_cast<double>(i) / n),
                         std::abs(cdf - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(distance * std::sqrt(n), 1.95);  // exceeded by chance once in 1000 seeds
}

TEST(RandomGaussianPair, ItsTwoNumbersAreUncorrelated) {
  constexpr std::uint64_t kPairs = 200000;
  double product = 0.0, product_of_squares = 0.0;
  for (std::uint64_t n = 0; n < kPairs; ++n) {
    const GaussianPair pair = random_gaussian_pair(13, n);
    product += pair.first * pair.second / kPairs;
    product_of_squares += (pair.first * pair.first - 1) * (pair.second * pair.second - 1) / kPairs;
  }
  EXPECT_NEAR(product, 0.0, 5.0 / std::sqrt(double{kPairs}));
  EXPECT_NEAR(product_of_squares, 0.0, 2.0 * 5.0 / std::sqrt(double{kPairs}));
}

}  // namespace
}  // namespace swell
