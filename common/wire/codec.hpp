#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/wire/register_map.hpp"

namespace cartwright::wire {

/// Values to registers and back, most significant register first. The spans hold at least as many registers
/// as the type takes; nothing here allocates except where a string is returned.
void put_u32(std::span<std::uint16_t> to, std::uint32_t value) noexcept;
void put_u64(std::span<std::uint16_t> to, std::uint64_t value) noexcept;
void put_f32(std::span<std::uint16_t> to, float value) noexcept;
void put_f64(std::span<std::uint16_t> to, double value) noexcept;
void put_text(std::span<std::uint16_t> to,
              std::string_view value) noexcept;  ///< cut to fit, padded with zeros

std::uint32_t get_u32(std::span<const std::uint16_t> from) noexcept;
std::uint64_t get_u64(std::span<const std::uint16_t> from) noexcept;
float get_f32(std::span<const std::uint16_t> from) noexcept;
double get_f64(std::span<const std::uint16_t> from) noexcept;
std::string get_text(std::span<const std::uint16_t> from);

/// One value of a register's type. Integers are rounded; a double holds every integer that the map uses
/// (below 2^53). f32 comes back as the number a person typed: see `widen`.
void put(const Register& what, std::span<std::uint16_t> to, double value) noexcept;
double get(const Register& what, std::span<const std::uint16_t> from) noexcept;

/// The double nearest to the shortest decimal that a float stands for: 0.1F becomes 0.1, not 0.10000000149.
double widen(float value) noexcept;

/// CRC-32 of ISO-HDLC (polynomial 0x04c11db7 reflected, as in zip and Ethernet): "123456789" gives
/// 0xcbf43926. Goes on from `crc` of what came before.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t crc = 0) noexcept;

/// The same over registers, high byte first, as they come over the wire.
std::uint32_t crc32(std::span<const std::uint16_t> words) noexcept;

}  // namespace cartwright::wire
