"""Sockets: TCPROS over asyncio streams, XML-RPC over aiohttp."""
