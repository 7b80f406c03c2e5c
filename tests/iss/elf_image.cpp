// SPDX-License-Identifier: MIT
#include "elf_image.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <elf.h>

namespace iss {
namespace {

class Reader {
public:
    explicit Reader(const std::filesystem::path &file) : name_(file.string())
    {
        std::ifstream in(file, std::ios::binary);
        octets_.assign(std::istreambuf_iterator<char>(in), {});
    }
    template <typename T> T at(std::size_t offset) const
    {
        T value{};
        std::memcpy(&value, bytes(offset, sizeof value), sizeof value);
        return value;
    }
    const char *bytes(std::size_t offset, std::size_t count) const
    {
        if (offset > octets_.size() || count > octets_.size() - offset) {
            throw std::runtime_error(name_ + ": is no whole ELF file");
        }
        return octets_.data() + offset;
    }
    std::string text(std::size_t offset) const
    {
        const char *const first = bytes(offset, 1);
        return {first, strnlen(first, octets_.size() - offset)};
    }
    const std::string &name() const
    {
        return name_;
    }

private:
    std::string       name_;
    std::vector<char> octets_;
};

void read_symbols(const Reader &r, const Elf32_Ehdr &head, ElfImage &image)
{
    for (std::size_t n = 0; n < head.e_shnum; n++) {
        const auto table = r.at<Elf32_Shdr>(head.e_shoff + n * sizeof(Elf32_Shdr));
        if (table.sh_type != SHT_SYMTAB) {
            continue;
        }
        const auto names = r.at<Elf32_Shdr>(head.e_shoff + table.sh_link * sizeof(Elf32_Shdr));
        for (std::size_t at = 0; at < table.sh_size; at += sizeof(Elf32_Sym)) {
            const auto symbol = r.at<Elf32_Sym>(table.sh_offset + at);
            if (symbol.st_name != 0) {
                const std::string name = r.text(names.sh_offset + symbol.st_name);
                image.symbols.emplace(name, symbol.st_value);
                if (symbol.st_size != 0) {
                    image.sizes.emplace(name, symbol.st_size);
                }
            }
        }
    }
}

} // namespace

ElfImage read_elf(const std::filesystem::path &file)
{
    const Reader r(file);
    const auto   head = r.at<Elf32_Ehdr>(0);
    if (std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS32 ||
        head.e_ident[EI_DATA] != ELFDATA2LSB || head.e_machine != EM_ARM) {
        throw std::runtime_error(r.name() + ": is no program for a 32-bit little-endian ARM");
    }
    ElfImage image;
    for (std::size_t n = 0; n < head.e_phnum; n++) {
        const auto segment = r.at<Elf32_Phdr>(head.e_phoff + n * sizeof(Elf32_Phdr));
        if (segment.p_type == PT_LOAD && segment.p_filesz > 0) {
            const char *const octets = r.bytes(segment.p_offset, segment.p_filesz);
            image.segments.push_back({segment.p_paddr, {octets, octets + segment.p_filesz}});
        }
    }
    read_symbols(r, head, image);
    return image;
}

} // namespace iss
