#include "firmware/modbus_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <modbus/modbus.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

namespace cartwright::firmware {
namespace {

constexpr std::size_t kMostClients = 16;
/// How often the server looks at the clock while no one asks anything.
constexpr int kPoll_ms = 20;
/// A client that sends half a request is dropped after this long.
constexpr std::uint32_t kHalfRequest_us = 100'000;
constexpr std::uint16_t kMostPerWrite = 123;

constexpr std::uint8_t kReadHolding = 3, kReadInput = 4, kWriteOne = 6, kWriteMany = 16;

struct FreeContext {
  void operator()(modbus_t* context) const { modbus_free(context); }
};
struct FreeMapping {
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};

std::uint16_t word(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>((static_cast<unsigned>(bytes[0]) << 8U) | bytes[1]);
}

}  // namespace

/// The sockets, the library's context, and the reply buffer.
class ModbusServer::Connections {
 public:
  struct Connection {
    int socket;
    Client client;
  };

  std::unique_ptr<modbus_t, FreeContext> context;
  std::unique_ptr<modbus_mapping_t, FreeMapping> mapping;
  int listener = -1;
  std::vector<Connection> open;

  ~Connections() {
    for (const Connection& connection : open) ::close(connection.socket);
    if (listener >= 0) ::close(listener);
  }

  void accept(RegisterFile& registers) {
    const int socket = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket < 0) return;
    if (open.size() >= kMostClients) {
      ::close(socket);
      return;
    }
    const int yes = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    open.push_back({socket, registers.connect()});
  }

  /// Takes one request and answers it. False when the client is gone.
  bool answer(Connection& connection, RegisterFile& registers, RegisterFile::Time now) {
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
    modbus_set_socket(context.get(), connection.socket);
    const int length = modbus_receive(context.get(), query.data());
    if (length < 0) return false;
    if (length == 0) return true;
    registers.heard(connection.client, now);
    const Answer outcome = carry_out(connection.client, registers, query, length, now);
    const int sent =
        outcome == Answer::good
            ? modbus_reply(context.get(), query.data(), length, mapping.get())
            : modbus_reply_exception(context.get(), query.data(), static_cast<unsigned>(outcome));
    return sent >= 0;
  }

 private:
  Answer carry_out(Client& client, RegisterFile& registers, const std::array<std::uint8_t, 260>& query,
                   int length, RegisterFile::Time now) {
    const auto header = static_cast<std::size_t>(modbus_get_header_length(context.get()));
    const std::uint8_t function = query[header];
    const std::uint8_t* const body = &query[header + 1];
    const std::uint16_t address = word(body), second = word(body + 2);
    if (function == kReadHolding || function == kReadInput) {
      if (second < 1 || second > wire::kMostPerRead) return Answer::illegal_value;
      if (address + second > wire::map_end()) return Answer::illegal_address;
      std::uint16_t* const table =
          function == kReadHolding ? mapping->tab_registers : mapping->tab_input_registers;
      return registers.read(client, address, std::span(table + address, second));
    }
    if (function == kWriteOne) return registers.write(client, address, std::span(&second, 1), now);
    if (function != kWriteMany) return Answer::illegal_function;
    const std::size_t most = static_cast<std::size_t>(length) - header - 6;
    if (second < 1 || second > kMostPerWrite || body[4] != 2 * second || most < 2U * second)
      return Answer::illegal_value;
    if (address + second > wire::map_end()) return Answer::illegal_address;
    std::array<std::uint16_t, kMostPerWrite> values{};
    for (std::size_t i = 0; i < second; ++i) values[i] = word(body + 5 + 2 * i);
    return registers.write(client, address, std::span(values.data(), second), now);
  }
};

Result<std::unique_ptr<ModbusServer>> ModbusServer::listen(const std::string& address, int port,
                                                           RegisterFile registers) {
  std::unique_ptr<ModbusServer> server(new ModbusServer(std::move(registers)));
  server->connections_ = std::make_unique<Connections>();
  Connections& c = *server->connections_;
  c.context.reset(modbus_new_tcp(address.c_str(), port));
  if (!c.context) return failure(fmt::format("listen = \"{}\" is not an IPv4 address", address));
  modbus_set_indication_timeout(c.context.get(), 0, kHalfRequest_us);
  modbus_set_byte_timeout(c.context.get(), 0, kHalfRequest_us);  // between the parts of one request
  c.mapping.reset(modbus_mapping_new(0, 0, wire::map_end(), wire::map_end()));
  if (!c.mapping) return failure("no memory for the register map");
  c.listener = modbus_tcp_listen(c.context.get(), static_cast<int>(kMostClients));
  if (c.listener < 0) {
    return failure(fmt::format("cannot listen on {}:{}: {}; choose another with --port, 0 for a free one",
                               address, port, modbus_strerror(errno)));
  }
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  if (::getsockname(c.listener, reinterpret_cast<sockaddr*>(&bound), &size) != 0)
    return failure("no port was bound");
  server->port_ = ntohs(bound.sin_port);
  return server;
}

ModbusServer::ModbusServer(RegisterFile registers) : registers_(std::move(registers)) {}

ModbusServer::~ModbusServer() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
}

void ModbusServer::start() {
  thread_ = std::thread([this] { serve(); });
}

void ModbusServer::serve() {
  Connections& c = *connections_;
  std::vector<pollfd> watched;
  while (!stop_.load()) {
    watched.assign(1, {c.listener, POLLIN, 0});
    for (const auto& connection : c.open) watched.push_back({connection.socket, POLLIN, 0});
    ::poll(watched.data(), watched.size(), kPoll_ms);
    const auto now = std::chrono::steady_clock::now();
    for (std::size_t i = c.open.size(); i-- > 0;) {
      if (watched[i + 1].revents == 0) continue;
      if (c.answer(c.open[i], registers_, now)) continue;
      registers_.disconnect(c.open[i].client, now);
      ::close(c.open[i].socket);
      c.open.erase(c.open.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if ((watched[0].revents & POLLIN) != 0) c.accept(registers_);
    registers_.watch(now);
  }
}

}  // namespace cartwright::firmware
