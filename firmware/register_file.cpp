#include "firmware/register_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/wire/codec.hpp"

namespace cartwright::firmware {
namespace {

using wire::Access;
using wire::Id;
using wire::Register;
using wire::Type;

/// An armed controller that no client commands is disarmed after this long.
constexpr std::chrono::seconds kUnattended{60};

/// The registers that overlap [address, end), whole or in part; empty where an address belongs to none.
std::vector<const Register*> overlapping(std::uint16_t address, std::size_t count) {
  std::vector<const Register*> found;
  std::size_t next = address;
  while (next < address + count) {
    const Register* r = next <= 0xffff ? wire::at(static_cast<std::uint16_t>(next)) : nullptr;
    if (!r) return {};
    found.push_back(r);
    next = r->end();
  }
  return found;
}

}  // namespace

RegisterFile::RegisterFile(const RigFile& rig, Exchange& exchange, const Telemetry& telemetry,
                           GainStore gains)
    : rig_(rig),
      exchange_(exchange),
      telemetry_(telemetry),
      gains_(std::move(gains)),
      settings_(rig.settings) {}

Client RegisterFile::connect() {
  Client client;
  last_client_ = static_cast<std::uint16_t>(last_client_ == 0xffff ? 1 : last_client_ + 1);
  client.number = last_client_;
  client.window.resize(wire::info(Id::log_window).size());
  return client;
}

void RegisterFile::disconnect(const Client& client, Time now) {
  if (client.number == owner_) lose_owner(now);
}

void RegisterFile::heard(const Client& client, Time now) {
  if (client.number == owner_) owner_heard_ = now;
}

void RegisterFile::lose_owner(Time now) {
  owner_ = 0;
  unattended_since_ = now;
  exchange_.host_lost.store(true, std::memory_order_release);
}

void RegisterFile::watch(Time now) {
  tell_notices();
  const std::chrono::duration<double> timeout(rig_.host_timeout_s);
  if (owner_ != 0) {
    if (now - owner_heard_ > timeout) lose_owner(now);
    return;
  }
  if (now - unattended_since_ < kUnattended || exchange_.status.read().state != wire::State::armed) return;
  request_ = {};
  request_.command = wire::Command::disarm;
  exchange_.requests.post(request_);
}

void RegisterFile::tell_notices() {
  const Status status = exchange_.status.read();
  if (status.notices == notices_told_) return;
  notices_told_ = status.notices;
  if (status.notice != wire::Notice::none) {
    std::fprintf(stderr, "cartwrightd: notice at %s\n", notice_sentence(status).c_str());
  }
}

RecordingEntry RegisterFile::recording_of(const Client& client, const Status& status) const {
  if (client.recording >= status.recordings) return {};
  RecordingEntry entry = exchange_.recordings[client.recording].read();
  if (entry.outcome == wire::Outcome::running) {
    entry.rows = static_cast<std::uint32_t>(exchange_.log.rows() - entry.first_row);
  }
  return entry;
}

Answer RegisterFile::read(const Client& client, std::uint16_t address, std::span<std::uint16_t> out) const {
  const auto wanted = overlapping(address, out.size());
  if (wanted.empty()) return Answer::illegal_address;
  const bool only_window = wanted.front()->id == Id::log_window;
  const Status status = only_window ? Status{} : exchange_.status.read();
  const RecordingEntry recording = only_window ? RecordingEntry{} : recording_of(client, status);
  std::array<std::uint16_t, 256> buffer{};
  for (const Register* r : wanted) {
    std::span<const std::uint16_t> words;
    if (r->id == Id::log_window) {
      words = client.window;
    } else {
      const std::span<std::uint16_t> to(buffer.data(), r->size());
      if (r->type == Type::text) {
        wire::put_text(to, text(r->id, status, recording));
      } else {
        wire::put(*r, to, number(r->id, client, status, recording));
      }
      words = to;
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::size_t at = r->address + i;
      if (at >= address && at < address + out.size()) out[at - address] = words[i];
    }
  }
  return Answer::good;
}

Answer RegisterFile::write(Client& client, std::uint16_t address, std::span<const std::uint16_t> values,
                           Time now) {
  const auto wanted = overlapping(address, values.size());
  if (wanted.empty() || wanted.front()->address != address ||
      wanted.back()->end() != address + values.size()) {
    return Answer::illegal_address;
  }
  std::vector<double> numbers;
  bool commands = false, sends = false;
  for (const Register* r : wanted) {
    if (!r->writable()) return Answer::illegal_address;
    commands = commands || r->access == Access::command;
    sends = sends || r->id == Id::command_code;
    const double value = wire::get(*r, values.subspan(r->address - address, r->size()));
    if (!(value >= r->least && value <= r->most)) return Answer::illegal_value;
    numbers.push_back(value);
  }
  if (commands && owner_ != 0 && owner_ != client.number) return Answer::busy;
  if (sends && !exchange_.requests.empty()) return Answer::busy;
  if (commands) {
    owner_ = client.number;
    owner_heard_ = now;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Id id = wanted[i]->id;
    if (id == Id::recording_select) {
      client.recording = static_cast<std::uint16_t>(numbers[i]);
    } else if (id == Id::log_page_row) {
      turn_page(client, static_cast<std::uint64_t>(numbers[i]));
    } else {
      settings_.set(id, numbers[i]);
    }
  }
  if (sends) command();
  return Answer::good;
}

void RegisterFile::turn_page(Client& client, std::uint64_t row) const {
  std::vector<LogRow> rows(wire::info(Id::log_window).count / kLogColumns);
  client.page_row = row;
  client.page_rows = static_cast<std::uint16_t>(exchange_.log.copy(row, rows));
  std::fill(client.window.begin(), client.window.end(), std::uint16_t{0});
  const std::span<std::uint16_t> window(client.window);
  std::size_t at = 0;
  for (std::size_t i = 0; i < client.page_rows; ++i) {
    for (const double value : rows[i]) {
      wire::put_f64(window.subspan(at), value);
      at += 4;
    }
  }
  client.page_crc = wire::crc32(std::span<const std::uint16_t>(window.first(at)));
}

void RegisterFile::answer(wire::Ack ack, wire::Reason reason, std::string words) {
  own_ack_ = ack;
  own_reason_ = reason;
  own_sequence_ = static_cast<std::uint16_t>(settings_.integer(Id::command_sequence));
  own_text_ = std::move(words);
}

void RegisterFile::command() {
  using wire::Ack;
  using wire::Command;
  using wire::Reason;
  const auto wanted = static_cast<Command>(settings_.integer(Id::command_code));
  request_ = {};
  request_.sequence = static_cast<std::uint16_t>(settings_.integer(Id::command_sequence));
  request_.command = wanted;
  own_ack_ = Ack::none;
  if (wanted == Command::release) {
    owner_ = 0;
    unattended_since_ = owner_heard_;
    return answer(Ack::done, Reason::none, {});
  }
  if (wanted == Command::run) {
    const auto programme = prepare(settings_, rig_);
    if (!programme) return answer(Ack::refused, Reason::bad_setup, programme.error().message);
    request_.programme = *programme;
    exchange_.host_lost.store(false, std::memory_order_release);
  } else if (wanted == Command::store_gains) {
    const auto stored = gains_.store(settings_.staged_gains());
    if (!stored) return answer(Ack::refused, Reason::not_stored, stored.error().message);
    request_.gains = gains_.slot(gains_.active())->gains;
  } else if (wanted == Command::activate_gains) {
    const auto activated = gains_.activate(settings_.integer(Id::command_argument));
    if (!activated) return answer(Ack::refused, Reason::bad_slot, activated.error().message);
    request_.gains = gains_.slot(gains_.active())->gains;
  } else if (wanted == Command::set_compensation) {
    const auto setup = compensation_from(settings_, rig_);
    if (!setup) return answer(Ack::refused, Reason::bad_setup, setup.error().message);
    request_.compensation = *setup;
  }
  exchange_.requests.post(request_);
}

}  // namespace cartwright::firmware
