// A Modbus device for command-line tests: modbus_server ADDRESS_FILE [tcp|rtu] [DIES_AFTER]. Writes its address for
// --modbus to the file, answers until standard input ends or this many requests have arrived, and then prints the codes of
// the requested functions.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "support/modbus_server.h"

int main(int argc, char** argv) {
    using clsurf::test::ModbusServer;
    if (argc < 2) return 2;
    const bool serial = argc > 2 && std::string(argv[2]) == "rtu";
    const int most = argc > 3 ? std::atoi(argv[3]) : 0;
    ModbusServer server(serial ? ModbusServer::Line::serial : ModbusServer::Line::tcp);
    server.start();
    const std::string unfinished = std::string(argv[1]) + ".new";
    std::ofstream(unfinished) << server.address();
    std::rename(unfinished.c_str(), argv[1]);  // so that the file appears complete
    for (;;) {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (::poll(&input, 1, 20) > 0) break;
        if (most > 0 && server.requests() >= most) break;
    }
    server.stop();
    for (const int function : server.functions()) std::printf("%d\n", function);
}
