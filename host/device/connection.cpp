#include "host/device/connection.hpp"

#include <fmt/format.h>
#include <modbus/modbus.h>
#include <netdb.h>

#include <cerrno>

namespace cartwright::device {
namespace {

/// Long enough for a controller on a busy machine, short enough for a person.
constexpr std::uint32_t kAnswer_s = 2;

/// libmodbus reports a name that does not resolve as a refused connection.
bool has_an_address(const std::string& host) {
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, nullptr, &found);
  if (found) freeaddrinfo(found);
  return error == 0;
}

}  // namespace

std::string Address::text() const {
  return fmt::format("{}:{}", host, port);
}

void Connection::Close::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

Answer<Connection> Connection::open(const Address& address) {
  const auto unreachable = [&](int error) {
    if (!has_an_address(address.host))
      return trouble(Cause::unreachable,
                     fmt::format("--host {}: no machine of that name is known here", address.host));
    return trouble(
        Cause::unreachable,
        fmt::format("no controller answers at {} ({}); start cartwrightd there, or name another with "
                    "--host and --port",
                    address.text(), modbus_strerror(error)));
  };
  std::unique_ptr<_modbus, Close> context(
      modbus_new_tcp_pi(address.host.c_str(), std::to_string(address.port).c_str()));
  if (!context) return unreachable(errno);
  modbus_set_response_timeout(context.get(), kAnswer_s, 0);
  if (modbus_connect(context.get()) != 0) return unreachable(errno);
  return Connection(std::move(context), address);
}

Trouble Connection::explain(int error, const char* doing, std::uint16_t address) const {
  if (error == EMBXSBUSY) {
    return {Cause::refused,
            "another client commands the controller, or a command is pending; its owner frees it by "
            "ending, by releasing it, or by falling silent"};
  }
  if (error == EMBXILVAL) {
    const wire::Register* what = wire::at(address);
    return {Cause::refused,
            fmt::format("the controller does not take that value for {}",
                        what ? std::string(what->name) : fmt::format("register {}", address))};
  }
  if (error == EMBXILADD || error == EMBXILFUN) {
    return {Cause::incompatible, fmt::format("{} is not a cartwrightd of this version: it has no register {}",
                                             address_.text(), address)};
  }
  return {Cause::lost, fmt::format("the connection to {} broke while {} register {} ({})", address_.text(),
                                   doing, address, modbus_strerror(error))};
}

Answer<void> Connection::read(std::uint16_t address, std::span<std::uint16_t> into) {
  const int count = static_cast<int>(into.size());
  if (modbus_read_registers(context_.get(), address, count, into.data()) == count) return {};
  return tl::unexpected(explain(errno, "reading", address));
}

Answer<void> Connection::write(std::uint16_t address, std::span<const std::uint16_t> values) {
  const int count = static_cast<int>(values.size());
  if (modbus_write_registers(context_.get(), address, count, values.data()) == count) return {};
  return tl::unexpected(explain(errno, "writing", address));
}

}  // namespace cartwright::device
