// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// An adaptive binary range coder [Martin1979], in the form that LZMA gave it, and whole numbers in its bits.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace foothold::benchmark {

/// The probability of a zero bit, learnt from the bits that came before.
class BitModel {
 public:
  std::uint32_t bound(std::uint32_t range) const { return (range >> kBits) * zero_; }
  void learn(bool bit) {
    if (bit) {
      zero_ -= zero_ >> kRate;
    } else {
      zero_ += ((1U << kBits) - zero_) >> kRate;
    }
  }

 private:
  static constexpr unsigned kBits = 12;
  static constexpr unsigned kRate = 5;
  std::uint32_t zero_ = 1U << (kBits - 1);
};

class BitEncoder {
 public:
  void code(bool& bit, BitModel& model) {
    const std::uint32_t bound = model.bound(range_);
    if (bit) {
      low_ += bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    model.learn(bit);
    while (range_ < kTop) {
      range_ <<= 8U;
      shift_low();
    }
  }
  std::vector<std::uint8_t> finish() {
    for (int i = 0; i < 5; ++i) shift_low();
    return std::move(bytes_);
  }

 private:
  static constexpr std::uint32_t kTop = 1U << 24U;
  void shift_low() {
    if (low_ < 0xFF000000U || low_ > 0xFFFFFFFFU) {
      const auto carry = static_cast<std::uint8_t>(low_ >> 32U);
      if (begun_) bytes_.push_back(static_cast<std::uint8_t>(held_ + carry));
      for (; num_held_ > 0; --num_held_) bytes_.push_back(static_cast<std::uint8_t>(0xFFU + carry));
      begun_ = true;
      held_ = static_cast<std::uint8_t>(low_ >> 24U);
    } else {
      ++num_held_;
    }
    low_ = (low_ & 0x00FFFFFFU) << 8U;
  }

  std::vector<std::uint8_t> bytes_;
  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFFU;
  std::uint8_t held_ = 0;
  bool begun_ = false;
  long num_held_ = 0;
};

/// Reads zeros behind the end.
class BitDecoder {
 public:
  BitDecoder(const std::uint8_t* begin, const std::uint8_t* end) : next_(begin), end_(end) {
    for (int i = 0; i < 4; ++i) code_ = code_ << 8U | read();
  }
  void code(bool& bit, BitModel& model) {
    const std::uint32_t bound = model.bound(range_);
    bit = code_ >= bound;
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    model.learn(bit);
    while (range_ < kTop) {
      range_ <<= 8U;
      code_ = code_ << 8U | read();
    }
  }

 private:
  static constexpr std::uint32_t kTop = 1U << 24U;
  std::uint32_t read() { return next_ < end_ ? *next_++ : 0; }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
  std::uint32_t range_ = 0xFFFFFFFFU;
  std::uint32_t code_ = 0;
};

/// Models of a whole number: whether it is zero, its sign, and its size: small ones one by one, large ones by their number of bits.
class NumberModel {
 public:
  /// With a BitEncoder writes the value, with a BitDecoder sets it. @pre |value| < 2^24.
  template <class Coder>
  void code(Coder& coder, int& value) {
    bool is_zero = value == 0;
    coder.code(is_zero, zero_);
    if (is_zero) {
      value = 0;
      return;
    }
    bool is_negative = value < 0;
    coder.code(is_negative, sign_);
    const std::uint32_t magnitude = code_magnitude(coder, static_cast<std::uint32_t>(std::abs(value)));
    value = is_negative ? -static_cast<int>(magnitude) : static_cast<int>(magnitude);
  }

 private:
  static constexpr std::uint32_t kSmall = 14;

  template <class Coder>
  std::uint32_t code_magnitude(Coder& coder, std::uint32_t magnitude) {
    for (std::uint32_t small = 1; small <= kSmall; ++small) {
      bool is_it = magnitude == small;
      coder.code(is_it, small_[small - 1]);
      if (is_it) return small;
    }
    std::uint32_t rest = magnitude - kSmall;  // at least 1
    unsigned num_bits = 1;
    for (;; ++num_bits) {
      bool is_longer = num_bits < 25 && (rest >> num_bits) != 0;
      coder.code(is_longer, length_[num_bits]);
      if (!is_longer || num_bits == 25) break;
    }
    std::uint32_t coded = 1;
    for (unsigned i = num_bits - 1; i-- > 0;) {
      bool bit = ((rest >> i) & 1U) != 0;
      coder.code(bit, bits_[i]);
      coded = coded << 1U | (bit ? 1U : 0U);
    }
    return coded + kSmall;
  }

  BitModel zero_;
  BitModel sign_;
  std::array<BitModel, kSmall> small_;
  std::array<BitModel, 26> length_;
  std::array<BitModel, 26> bits_;
};

}  // namespace foothold::benchmark
