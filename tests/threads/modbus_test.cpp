// A loop, a server and clients on three threads, over real sockets.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <modbus/modbus.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>

#include "common/wire/codec.hpp"
#include "firmware/modbus_server.hpp"
#include "hal/sim/simulated_cart.hpp"

namespace cartwright::firmware {
namespace {

using wire::Command;
using wire::Id;

/// A Modbus client that speaks in registers of the map.
class Host {
 public:
  explicit Host(int port) : context_(modbus_new_tcp("127.0.0.1", port)) {
    connected_ = modbus_connect(context_) == 0;
  }
  Host(const Host&) = delete;
  ~Host() {
    modbus_close(context_);
    modbus_free(context_);
  }

  bool connected() const { return connected_; }
  modbus_t* raw() { return context_; }

  double get(Id id) {
    const wire::Register& r = wire::info(id);
    std::array<std::uint16_t, 4> words{};
    EXPECT_EQ(modbus_read_registers(context_, r.address, r.width(), words.data()), r.width()) << r.name;
    return wire::get(r, words);
  }

  std::string text(Id id) {
    const wire::Register& r = wire::info(id);
    std::vector<std::uint16_t> words(r.size());
    for (int at = 0; at < r.size(); at += wire::kMostPerRead) {
      const int count = std::min<int>(wire::kMostPerRead, r.size() - at);
      EXPECT_EQ(modbus_read_registers(context_, r.address + at, count, words.data() + at), count);
    }
    return wire::get_text(words);
  }

  /// 0, or the Modbus exception.
  int set(Id id, double value) {
    const wire::Register& r = wire::info(id);
    std::array<std::uint16_t, 4> words{};
    wire::put(r, words, value);
    return write(r.address, std::span(words.data(), r.width()));
  }

  int write(int address, std::span<const std::uint16_t> words) {
    if (modbus_write_registers(context_, address, static_cast<int>(words.size()), words.data()) >= 0)
      return 0;
    return errno - MODBUS_ENOBASE;
  }

  /// Sends a command and waits for the answer.
  wire::Ack command(Command code, std::uint16_t argument = 0) {
    const std::array<std::uint16_t, 3> words{++sequence_, static_cast<std::uint16_t>(code), argument};
    if (write(wire::info(Id::command_sequence).address, words) != 0) return wire::Ack::none;
    for (int i = 0; i < 2000; ++i) {
      const auto ack = static_cast<wire::Ack>(get(Id::ack_result));
      if (get(Id::ack_sequence) == sequence_ && ack != wire::Ack::pending) return ack;
    }
    return wire::Ack::pending;
  }

  bool wait_until_over() {
    for (int i = 0; i < 20'000; ++i) {
      if (get(Id::state) != static_cast<double>(wire::State::running)) return true;
    }
    return false;
  }

 private:
  modbus_t* context_;
  bool connected_ = false;
  std::uint16_t sequence_ = 0;
};

class Served : public testing::Test {
 protected:
  void SetUp() override {
    directory = std::filesystem::temp_directory_path() / ("cartwright-modbus-" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory);
    rig.rig.encoder_resolution_m = 2.275e-5;
    rig.virtual_time = true;
    rig.gain_file = directory / "gains.txt";
    rig.host_timeout_s = 0.3;
    auto store = GainStore::open(rig.gain_file);
    server = std::move(
        *ModbusServer::listen("127.0.0.1", 0, RegisterFile(rig, exchange, telemetry, std::move(*store))));
    server->start();
    loop_thread = std::thread([this] { loop.run(stop); });
  }

  void TearDown() override {
    server.reset();
    stop = true;
    loop_thread.join();
    std::filesystem::remove_all(directory);
  }

  std::filesystem::path directory;
  RigFile rig;
  hal::sim::SimulatedCart cart{[] {
    hal::sim::CartSetup setup;
    setup.model = Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5);
    return setup;
  }()};
  Exchange exchange{20'000};
  Telemetry telemetry;
  Controller controller{controller_setup(rig), cart.devices(), exchange};
  VirtualPacer pacer{200'000};
  Loop loop{controller, pacer, 1'000'000, telemetry};
  std::atomic<bool> stop{false};
  std::thread loop_thread;
  std::unique_ptr<ModbusServer> server;
};

TEST_F(Served, AClientReadsTheMapWithoutCommanding) {
  Host host(server->port());
  ASSERT_TRUE(host.connected());
  EXPECT_EQ(host.get(Id::map_version), wire::kMapVersion);
  EXPECT_EQ(host.get(Id::voltage_limit_V), 12);
  EXPECT_EQ(host.get(Id::travel_low_m), -0.4);
  EXPECT_EQ(host.text(Id::log_schema), log_schema());
  EXPECT_TRUE(std::isnan(host.get(Id::live_current_A)));
  EXPECT_EQ(host.get(Id::owner), 0);
  EXPECT_EQ(host.get(Id::you), 1);
  for (const wire::Register& r : wire::registers()) {
    std::vector<std::uint16_t> words(std::min<std::size_t>(r.size(), wire::kMostPerRead));
    EXPECT_GT(
        modbus_read_input_registers(host.raw(), r.address, static_cast<int>(words.size()), words.data()), 0)
        << r.name;
  }
}

TEST_F(Served, WrongRequestsGetAnExceptionAndChangeNothing) {
  Host host(server->port());
  ASSERT_EQ(host.set(Id::step_amplitude_m, 0.05), 0);
  EXPECT_EQ(host.set(Id::step_amplitude_m, 99), MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  EXPECT_EQ(host.set(Id::step_amplitude_m, std::numeric_limits<double>::quiet_NaN()),
            MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  EXPECT_EQ(host.set(Id::experiment_kind, 77), MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  EXPECT_EQ(host.set(Id::voltage_limit_V, 100), MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS);
  const std::uint16_t half = 0x3f80;
  EXPECT_EQ(host.write(wire::info(Id::step_amplitude_m).address, std::span(&half, 1)),
            MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS);
  // A good value together with a bad one: neither is taken.
  std::array<std::uint16_t, 4> two{};
  wire::put_f32(std::span(two).first(2), 5.0F);
  wire::put_f32(std::span(two).last(2), -5.0F);
  EXPECT_EQ(host.write(wire::info(Id::relay_h1_V).address, two), MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE);
  EXPECT_EQ(host.get(Id::relay_h1_V), 2);
  EXPECT_EQ(host.get(Id::step_amplitude_m), 0.05);
  std::uint16_t word = 0;
  EXPECT_EQ(modbus_read_registers(host.raw(), 39, 1, &word), -1);
  EXPECT_EQ(errno, EMBXILADD);
  std::uint8_t bit = 0;
  EXPECT_EQ(modbus_read_bits(host.raw(), 0, 1, &bit), -1);
  EXPECT_EQ(errno, EMBXILFUN);
  EXPECT_EQ(host.get(Id::map_version), wire::kMapVersion) << "the connection survives all of it";
}

TEST_F(Served, AnExperimentRunsAndItsLogComesOverWithItsChecksums) {
  Host host(server->port());
  ASSERT_EQ(host.set(Id::experiment_kind, 1), 0);
  ASSERT_EQ(host.set(Id::step_amplitude_m, 0.05), 0);
  EXPECT_EQ(host.command(Command::run), wire::Ack::refused);
  EXPECT_NE(host.text(Id::ack_text).find("disarmed"), std::string::npos);
  ASSERT_EQ(host.command(Command::arm), wire::Ack::done);
  ASSERT_EQ(host.command(Command::run), wire::Ack::done);
  ASSERT_TRUE(host.wait_until_over());
  EXPECT_EQ(host.get(Id::outcome), static_cast<double>(wire::Outcome::finished));
  ASSERT_EQ(host.get(Id::recording_count), 1);
  ASSERT_EQ(host.set(Id::recording_select, 0), 0);
  EXPECT_EQ(host.text(Id::recording_file), "step.csv");
  EXPECT_EQ(host.get(Id::recording_rows), 6000);
  EXPECT_EQ(host.get(Id::recording_lost_rows), 0);
  EXPECT_EQ(host.get(Id::recording_kp_V_per_m), 60);

  double row = host.get(Id::recording_first_row);
  const double end = row + host.get(Id::recording_rows);
  double greatest = 0;
  while (row < end) {
    ASSERT_EQ(host.set(Id::log_page_row, row), 0);
    const auto rows = static_cast<std::size_t>(host.get(Id::log_page_rows));
    ASSERT_GT(rows, 0U);
    std::vector<std::uint16_t> window(rows * kLogColumns * 4);
    for (std::size_t at = 0; at < window.size(); at += wire::kMostPerRead) {
      const int count = static_cast<int>(std::min<std::size_t>(wire::kMostPerRead, window.size() - at));
      ASSERT_EQ(modbus_read_registers(host.raw(), wire::info(Id::log_window).address + static_cast<int>(at),
                                      count, &window[at]),
                count);
    }
    ASSERT_EQ(wire::crc32(std::span<const std::uint16_t>(window)), host.get(Id::log_page_crc));
    for (std::size_t i = 0; i < rows; ++i) {
      greatest = std::max(greatest, wire::get_f64(std::span(window).subspan(i * kLogColumns * 4 + 4)));
    }
    row += static_cast<double>(rows);
  }
  EXPECT_EQ(greatest, 0.05) << "the reference, as it was typed";
}

TEST_F(Served, OnlyOneClientCommandsUntilItReleasesOrLeaves) {
  auto first = std::make_unique<Host>(server->port());
  Host second(server->port());
  ASSERT_EQ(first->command(Command::arm), wire::Ack::done);
  EXPECT_EQ(second.set(Id::step_amplitude_m, 0.05), MODBUS_EXCEPTION_SLAVE_OR_SERVER_BUSY);
  EXPECT_EQ(second.command(Command::disarm), wire::Ack::none);
  EXPECT_EQ(second.get(Id::state), static_cast<double>(wire::State::armed));
  EXPECT_EQ(second.set(Id::log_page_row, 0), 0) << "reading the log is not commanding";
  EXPECT_EQ(second.get(Id::owner), first->get(Id::you));
  ASSERT_EQ(first->command(Command::release), wire::Ack::done);
  EXPECT_EQ(second.command(Command::disarm), wire::Ack::done);
  second.command(Command::release);
  ASSERT_EQ(first->set(Id::step_amplitude_m, 0.07), 0);
  first.reset();
  int refused = 1;
  for (int i = 0; i < 200 && refused != 0; ++i) refused = second.set(Id::step_amplitude_m, 0.05);
  EXPECT_EQ(refused, 0) << "who disconnects no longer commands";
}

TEST_F(Served, GainsAreStoredActivatedAndRefused) {
  Host host(server->port());
  EXPECT_EQ(host.get(Id::gain_slot), 0);
  ASSERT_EQ(host.set(Id::staged_kp_V_per_m, 75), 0);
  ASSERT_EQ(host.command(Command::store_gains), wire::Ack::done);
  EXPECT_EQ(host.get(Id::gain_slot), 1);
  EXPECT_EQ(host.get(Id::active_kp_V_per_m), 75);
  EXPECT_EQ(host.get(Id::slot1_generation), 1);
  EXPECT_EQ(host.command(Command::activate_gains, 2), wire::Ack::refused);
  EXPECT_EQ(host.get(Id::ack_reason), static_cast<double>(wire::Reason::bad_slot));
  EXPECT_EQ(host.get(Id::active_kp_V_per_m), 75);
  EXPECT_EQ(GainStore::open(rig.gain_file)->slot(1)->gains.pd.kp_V_per_m, 75);
}

TEST_F(Served, ASetUpThatDoesNotFitTheRigIsRefusedInWords) {
  Host host(server->port());
  ASSERT_EQ(host.set(Id::experiment_kind, 6), 0);
  ASSERT_EQ(host.set(Id::hold_position_m, 1.5), 0);
  ASSERT_EQ(host.command(Command::arm), wire::Ack::done);
  EXPECT_EQ(host.command(Command::run), wire::Ack::refused);
  EXPECT_NE(host.text(Id::ack_text).find("hold_position_m asks for 1.5 m"), std::string::npos);
}

TEST_F(Served, AClientThatSendsHalfARequestDoesNotHoldUpTheOthers) {
  Host broken(server->port());
  ASSERT_EQ(::write(modbus_get_socket(broken.raw()), "\0\1\0\0", 4), 4);
  Host host(server->port());
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(host.get(Id::map_version), wire::kMapVersion);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(RegisterFile, ASilentOwnerLosesCommandAndTheExperiment) {
  // The server's clock is handed in: nothing here waits.
  RigFile rig;
  Exchange exchange{100};
  Telemetry telemetry;
  RegisterFile registers(rig, exchange, telemetry, {});
  Client owner = registers.connect(), other = registers.connect();
  RegisterFile::Time now{};
  now += std::chrono::hours(1);
  const wire::Register& lines = wire::info(Id::track_lines);
  const std::uint16_t value = 5;
  ASSERT_EQ(registers.write(owner, lines.address, std::span(&value, 1), now), Answer::good);
  now += std::chrono::milliseconds(1900);
  registers.watch(now);
  EXPECT_EQ(registers.write(other, lines.address, std::span(&value, 1), now), Answer::busy);
  registers.heard(owner, now);
  now += std::chrono::milliseconds(1900);
  registers.watch(now);
  EXPECT_FALSE(exchange.host_lost);
  now += std::chrono::milliseconds(200);
  registers.watch(now);
  EXPECT_TRUE(exchange.host_lost);
  EXPECT_EQ(registers.write(other, lines.address, std::span(&value, 1), now), Answer::good);
}

TEST_F(Served, CompensationIsSetWhileTheLoopRunsAndItsEstimatesCanBeReadAllTheWhile) {
  Host host(server->port());
  ASSERT_TRUE(host.connected());
  ASSERT_EQ(host.set(Id::compensation_mode, 2), 0);
  EXPECT_EQ(host.command(Command::set_compensation), wire::Ack::refused) << "no model yet";
  EXPECT_NE(host.text(Id::ack_text).find("needs a model"), std::string::npos);
  ASSERT_EQ(host.set(Id::model_voltage_gain_m_per_s2_V, 1.9), 0);
  ASSERT_EQ(host.set(Id::model_viscous_friction_coefficient_per_s, 5), 0);
  ASSERT_EQ(host.set(Id::model_coulomb_friction_level_m_per_s2, 0.5), 0);
  ASSERT_EQ(host.set(Id::experiment_kind, 3), 0);
  ASSERT_EQ(host.set(Id::experiment_duration_s, 15), 0);
  ASSERT_EQ(host.command(Command::arm), wire::Ack::done);
  ASSERT_EQ(host.command(Command::run), wire::Ack::done);
  ASSERT_EQ(host.command(Command::set_compensation), wire::Ack::done);
  EXPECT_EQ(host.get(Id::live_compensation), 2);
  double worst_b = 0, worst_gain = 0;
  while (host.get(Id::state) == static_cast<double>(wire::State::running)) {
    worst_b = std::max(worst_b, std::abs(host.get(Id::estimate_b_V_s2_per_m) - 1 / 1.9));
    const double gain = host.get(Id::identified_gain_m_per_s2_V);
    if (!std::isnan(gain)) worst_gain = std::max(worst_gain, std::abs(gain - 1.9));
  }
  EXPECT_LT(worst_b, 0.05 / 1.9) << "the model is right: switching it on teaches nothing";
  EXPECT_LT(worst_gain, 0.02);
  EXPECT_EQ(host.get(Id::outcome), static_cast<double>(wire::Outcome::finished));
  EXPECT_EQ(host.command(Command::restart_identification), wire::Ack::done);
  EXPECT_TRUE(std::isnan(host.get(Id::identified_gain_m_per_s2_V)));
}

}  // namespace
}  // namespace cartwright::firmware
